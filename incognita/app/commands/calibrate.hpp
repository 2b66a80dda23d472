// `incognita calibrate`: camera intrinsics from images of a chessboard, and conversion of calibration files.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace incognita {

/// Adds the command. If it is selected, `job` is set. The job returns 0 on success and 1 if the images do not determine the camera; it
/// throws InputError for an invalid option or file.
CLI::App* add_calibrate(CLI::App& app, std::function<int()>& job);

}  // namespace incognita
