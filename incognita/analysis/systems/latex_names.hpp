// Names of a system in LaTeX.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace incognita {

struct SymbolicSystem;

/// `theta` becomes \theta, `xf` x_{f}, `hitch` \mathit{hitch}. For names of letters, digits and underscores;
/// two names may map to the same LaTeX.
std::string latex_name(const std::string& name);

/// Arbitrary text, as LaTeX text.
std::string latex_text(const std::string& text);

/// The names of one system, mapped uniquely: of `xf` and `x_f` the second is spelled out.
class LatexNames {
 public:
  LatexNames() = default;
  explicit LatexNames(const std::vector<std::string>& names);

  /// LaTeX of these names, and of those derived from them: `L_v x`, `v(2)`.
  std::string operator()(const std::string& name) const;

 private:
  std::map<std::string, std::string> known_;
};

/// All names that expressions and error states of the system may use.
LatexNames latex_names(const SymbolicSystem& system);

}  // namespace incognita
