#include "incognita/analysis/systems/latex_names.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "incognita/analysis/systems/symbolic_system.hpp"

namespace incognita {
namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

bool is_greek(const std::string& name) {
  static const std::set<std::string> greek{
      "alpha", "beta", "gamma", "delta",   "epsilon", "zeta",  "eta",   "theta", "iota",  "kappa", "lambda",
      "mu",    "nu",   "xi",    "pi",      "rho",     "sigma", "tau",   "phi",   "chi",   "psi",   "omega",
      "Gamma", "Xi",   "Delta", "upsilon", "Lambda",  "Pi",    "Theta", "Sigma", "Omega", "Phi",   "Psi"};
  return greek.contains(name);
}

/// Two letters are a symbol with an index, and so are three that end in an axis: `qex`. Longer ones are words.
bool is_word(const std::string& letters) {
  const bool axis = letters.size() == 3 && std::string("xyz").find(letters.back()) != std::string::npos;
  return letters.size() > 2 && !axis;
}

std::string italic(const std::string& word) {
  std::string escaped;
  for (const char c : word) escaped += c == '_' ? "\\_" : std::string(1, c);
  return "\\mathit{" + escaped + "}";
}

/// Joins the parts between underscores by commas; words are set in italics.
std::string written_index(const std::string& index) {
  std::string all, part;
  const auto end_part = [&] {
    if (part.empty()) return;
    const auto letters = std::count_if(part.begin(), part.end(), is_letter);
    all += (all.empty() ? "" : ",") + (letters > 2 ? italic(part) : part);
    part.clear();
  };
  for (const char c : index) {
    if (c == '_')
      end_part();
    else
      part += c;
  }
  end_part();
  return all;
}

}  // namespace

std::string latex_name(const std::string& name) {
  const auto letters =
      static_cast<std::size_t>(std::find_if_not(name.begin(), name.end(), is_letter) - name.begin());
  if (letters == 0) return name;
  std::string head = name.substr(0, letters), index = name.substr(letters);
  if (is_greek(head)) {
    head = "\\" + head;
  } else if (is_word(head)) {
    head = italic(head);
  } else {
    index = head.substr(1) + index;
    head.resize(1);
  }
  index = written_index(index);
  return index.empty() ? head : head + "_{" + index + "}";
}

std::string latex_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\' || c == '^' || c == '~') {
      out += c == '\\' ? "\\textbackslash{}" : std::string("\\") + c + "{}";
      continue;
    }
    if (std::string("_%&#${}").find(c) != std::string::npos) out += '\\';
    out += c;
  }
  return out;
}

LatexNames::LatexNames(const std::vector<std::string>& names) {
  std::set<std::string> taken{"\\pi"};  // the number
  for (const std::string& name : names) {
    if (known_.contains(name)) continue;
    const std::string usual = latex_name(name);
    // The spelled-out form is unique
    known_[name] = taken.insert(usual).second ? usual : italic(name);
  }
}

std::string LatexNames::operator()(const std::string& name) const {
  const auto found = known_.find(name);
  if (found != known_.end()) return found->second;
  const std::size_t space = name.find(' '), open = name.rfind('(');
  if (name.starts_with("L_") && space != std::string::npos)
    return "\\mathcal{L}_{" + (*this)(name.substr(2, space - 2)) + "} " + (*this)(name.substr(space + 1));
  // In braces, since it may be raised to a power
  if (name.ends_with(')')) return "{" + (*this)(name.substr(0, open)) + "^{" + name.substr(open) + "}}";
  if (name.starts_with("d ") && name.ends_with("/dt"))
    return "\\dot{" + (*this)(name.substr(2, name.size() - 5)) + "}";
  return latex_name(name);
}

LatexNames latex_names(const SymbolicSystem& s) {
  std::vector<std::string> names;
  for (ExpressionGraph::Slot slot = 0; slot < s.graph.size(); ++slot) {
    const std::string& name = s.graph[slot].name;
    // Without the copies of the Lie algebra, v(2), which look like their originals
    if (s.graph[slot].named && name.find('(') == std::string::npos) names.push_back(name);
  }
  for (const auto* block : {&s.vehicle, &s.landmark, &s.anchor})
    for (const auto measurement : block->measurements) names.push_back(s.graph[measurement].name);
  for (const auto* errors : {&s.vehicle_error_names, &s.landmark_error_names})
    for (const std::string& name : *errors)
      if (std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; }))
        names.push_back(name);
  return LatexNames(names);
}

}  // namespace incognita
