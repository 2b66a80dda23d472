// The name a person probably meant; written where the rooms before this one find it too.
#pragma once

#include "incognita/math/nearest_name.hpp"
