#define INCOGNITA_RANK_UPDATE_PATH avx512
#include "incognita/belief/rank_update_kernel.inl"
