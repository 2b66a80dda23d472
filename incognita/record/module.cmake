find_package(fmt REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(MATIO REQUIRED IMPORTED_TARGET GLOBAL matio)

incognita_module(record FOLDERS record record/files record/snapshot record/summary record/mcap record/replay
                 WITHOUT record/frame_pictures.cpp
                 USES incognita::math incognita::models incognita::messages incognita::analysis incognita::bags
                 PRIVATE_USES fmt::fmt nlohmann_json::nlohmann_json opencv_core opencv_imgcodecs
                              PkgConfig::MATIO)

# A separate target, because only programs that draw pictures should link OpenCV imgproc
incognita_module(pictures SOURCES record/frame_pictures.cpp USES incognita::record
                 PRIVATE_USES fmt::fmt opencv_core opencv_imgproc opencv_imgcodecs)
