// Names of a system as a person typesets them.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace incognita {

struct SymbolicSystem;

/// `theta` is \theta, `xf` x_{f}, `hitch` \mathit{hitch}. Letters, digits and underscores; two names may come
/// to look the same.
std::string latex_name(const std::string& name);

/// Any text, in text.
std::string latex_text(const std::string& text);

/// The names of one system: different ones look different, of `xf` and `x_f` the second is written out.
class LatexNames {
 public:
  LatexNames() = default;
  explicit LatexNames(const std::vector<std::string>& names);

  /// Of these, and of what derivation makes of them: `L_v x`, `v(2)`.
  std::string operator()(const std::string& name) const;

 private:
  std::map<std::string, std::string> known_;
};

/// All that expressions and error states of the system may name.
LatexNames latex_names(const SymbolicSystem& system);

}  // namespace incognita
