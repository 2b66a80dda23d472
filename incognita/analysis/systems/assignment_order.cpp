#include "incognita/analysis/systems/assignment_order.hpp"

#include <algorithm>

namespace incognita {
namespace {

using Assignment = SymbolicSystem::Assignment;
using Slot = SymbolicSystem::Slot;

/// Depth-first search: an assignment is placed after all those it depends on.
class Order {
 public:
  Order(const ExpressionGraph& graph, const std::vector<Assignment>& assignments)
      : graph_(graph), assignments_(assignments), marks_(assignments.size(), Mark::open) {}

  std::vector<Assignment> run() {
    for (const bool inputs : {false, true})
      for (std::size_t i = 0; i < assignments_.size(); ++i)
        if (assignments_[i].to_input == inputs) place(i);
    return std::move(placed_);
  }

 private:
  enum class Mark { open, pending, placed };

  void place(std::size_t which) {
    if (marks_[which] == Mark::placed) return;
    path_.push_back(which);
    if (marks_[which] == Mark::pending) refuse_cycle();
    marks_[which] = Mark::pending;
    const std::vector<bool> named = graph_.needed_for({assignments_[which].value});
    for (std::size_t i = 0; i < assignments_.size(); ++i) {
      const bool both_states = !assignments_[i].to_input && !assignments_[which].to_input;
      if (!both_states && named[static_cast<std::size_t>(assignments_[i].target)]) place(i);
    }
    marks_[which] = Mark::placed;
    placed_.push_back(assignments_[which]);
    path_.pop_back();
  }

  std::string name(std::size_t which) const { return "`" + graph_[assignments_[which].target].name + "`"; }

  /// The last entry of the path occurs in it twice.
  [[noreturn]] void refuse_cycle() const {
    const auto first = std::find(path_.begin(), path_.end(), path_.back());
    std::string cycle = name(*first);
    for (auto next = first + 1; next != path_.end(); ++next)
      cycle += (next == first + 1 ? " depends on " : ", which depends on ") + name(*next);
    throw SystemError(graph_[assignments_[*first].value].location,
                      "the motion's assignments are circular: " + cycle +
                          "; replace one of them by a drawn number (draw.q = [lowest, highest])");
  }

  const ExpressionGraph& graph_;
  const std::vector<Assignment>& assignments_;
  std::vector<Mark> marks_;
  std::vector<std::size_t> path_;
  std::vector<Assignment> placed_;
};

}  // namespace

std::vector<Assignment> in_order_of_evaluation(const ExpressionGraph& graph,
                                               const std::vector<Assignment>& assignments) {
  return Order(graph, assignments).run();
}

}  // namespace incognita
