#include "incognita/record/summary/run_info.hpp"

#include "incognita/analysis/evaluation/trajectory.hpp"

namespace incognita {

bool same_frame_as_truth(const RunInfo& info) { return info.ate_alignment == name(AlignmentKind::none); }
bool scale_is_known(const RunInfo& info) { return info.ate_alignment != name(AlignmentKind::sim3); }

}  // namespace incognita
