#define INCOGNITA_RANK_UPDATE_PATH baseline
#include "incognita/belief/rank_update_kernel.inl"
