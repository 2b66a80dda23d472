#define INCOGNITA_RANK_UPDATE_PATH baseline
#define INCOGNITA_RANK_UPDATE_LANES 2
#define INCOGNITA_RANK_UPDATE_COLUMNS 2
#define INCOGNITA_RANK_UPDATE_PANELS 1
#include "incognita/belief/rank_update_kernel.inl"
