incognita_room(report
  SOURCES report/campaign_limit.cpp report/campaign_measures.cpp report/campaign_statistics.cpp report/campaign_table.cpp report/child_process.cpp report/csv_table.cpp report/figure_scripts.cpp report/figure_style.cpp
          report/gnuplot.cpp report/ledger.cpp report/observability_answer.cpp report/plot.cpp report/run_figures.cpp
          report/team_figures.cpp
  USES incognita::record incognita::analysis PRIVATE_USES fmt::fmt nlohmann_json::nlohmann_json)

include(app/evaluate.cmake OPTIONAL)
incognita_cold(incognita_report)
