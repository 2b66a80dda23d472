find_package(PkgConfig REQUIRED)
pkg_check_modules(GINAC REQUIRED IMPORTED_TARGET GLOBAL ginac)

# What needs computer algebra is a target of its own (systems), so that a program that wants trajectories links none
set(algebraic analysis/observability/explain_observability.cpp analysis/observability/lie_derivatives.cpp
              analysis/observability/observability.cpp analysis/observability/observability_latex.cpp
              analysis/observability/observability_matrices.cpp)
set(numeric analysis/systems/expression_guard.cpp analysis/systems/expression_postfix.cpp
            analysis/systems/system_check.cpp)
incognita_module(analysis FOLDERS analysis/observability analysis/evaluation WITHOUT ${algebraic} SOURCES ${numeric}
                 USES incognita::math incognita::models incognita::belief PRIVATE_USES Boost::headers)
incognita_module(systems FOLDERS analysis/systems WITHOUT ${numeric} SOURCES ${algebraic}
                 USES incognita::analysis PRIVATE_USES PkgConfig::GINAC Boost::headers)
