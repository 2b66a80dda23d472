#include "incognita/vision/image.hpp"
