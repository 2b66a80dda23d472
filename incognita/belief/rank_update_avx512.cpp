#define INCOGNITA_RANK_UPDATE_PATH avx512
#define INCOGNITA_RANK_UPDATE_LANES 8
#define INCOGNITA_RANK_UPDATE_COLUMNS 8
#define INCOGNITA_RANK_UPDATE_PANELS 3
#include "incognita/belief/rank_update_kernel.inl"
