incognita_module(report FOLDERS report USES incognita::record incognita::analysis
                 PRIVATE_USES fmt::fmt nlohmann_json::nlohmann_json)

include(app/commands/evaluate.cmake)
incognita_cold(incognita_report)
