find_package(CLI11 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
incognita_test(report_test SOURCES report/campaign_table_test.cpp report/ledger_test.cpp report/plot_test.cpp report/run_figures_test.cpp
               USES incognita::report nlohmann_json::nlohmann_json)
incognita_test(evaluate_test SOURCES app/evaluate_test.cpp
               USES incognita::evaluate CLI11::CLI11 nlohmann_json::nlohmann_json)
