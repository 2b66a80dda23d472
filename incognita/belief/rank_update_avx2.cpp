#define INCOGNITA_RANK_UPDATE_PATH avx2
#define INCOGNITA_RANK_UPDATE_LANES 4
#define INCOGNITA_RANK_UPDATE_COLUMNS 4
#define INCOGNITA_RANK_UPDATE_PANELS 1
#include "incognita/belief/rank_update_kernel.inl"
