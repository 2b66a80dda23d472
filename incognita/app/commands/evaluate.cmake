# `incognita evaluate`: a separate target, since it needs neither a world nor an estimator
find_package(CLI11 REQUIRED)
incognita_module(evaluate SOURCES app/commands/compare_trajectories.cpp app/commands/evaluate.cpp USES incognita::record incognita::analysis
               PRIVATE_USES fmt::fmt nlohmann_json::nlohmann_json CLI11::CLI11)
incognita_cold(incognita_evaluate)
