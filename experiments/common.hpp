// What nearly every experiment uses: its declaration, claims with their verdicts, independent runs, plots and
// formatted text.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "experiments/cases.hpp"
#include "experiments/curves.hpp"
#include "experiments/entry.hpp"
#include "experiments/evidence.hpp"
#include "experiments/list.hpp"
#include "experiments/seeds.hpp"
#include "experiments/worst.hpp"
#include "incognita/report/plot.hpp"
