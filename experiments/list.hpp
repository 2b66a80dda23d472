// Every experiment, one line each, in the thesis' order. Its file includes this header, which is what makes
// the constant in it known elsewhere; all_experiments.cpp puts it on the list that the program has.
#pragma once

#include "incognita/report/experiment.hpp"

namespace incognita {

extern const Experiment text_chapters_1_to_3;
extern const Experiment example_3_1;
extern const Experiment example_3_2;
extern const Experiment example_3_3;
extern const Experiment example_3_4;
extern const Experiment example_3_5;
extern const Experiment example_3_6;
extern const Experiment example_3_7;
extern const Experiment example_3_8;
extern const Experiment example_3_9;
extern const Experiment example_3_10;
extern const Experiment example_3_11;
extern const Experiment text_chapter_4;
extern const Experiment example_4_1;
extern const Experiment example_4_2;
extern const Experiment example_4_3;
extern const Experiment example_4_4;
extern const Experiment example_4_5;
extern const Experiment example_4_6;
extern const Experiment example_5_1;
extern const Experiment example_5_2;
extern const Experiment example_5_3;
extern const Experiment mrclam;
extern const Experiment example_5_4;
extern const Experiment section_6_1;
extern const Experiment section_6_3;
extern const Experiment section_6_3_2;
extern const Experiment section_6_4;
extern const Experiment section_6_4_3;
extern const Experiment consistency;

}  // namespace incognita
