// Expressions: precedence, values, derivatives, and an order of terms that does not depend on how they were
// built.
#include "incognita/analysis/systems/expression_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "incognita/analysis/systems/canonical_expression.hpp"
#include "incognita/math/random.hpp"

namespace incognita {
namespace {

struct Evaluated {
  double value = 0;
  Eigen::VectorXd gradient;
};

/// Value of an expression in a and b.
Evaluated evaluate(const std::string& text, double a, double b) {
  ExpressionGraph graph;
  const auto slot_a = graph.add_atom("a", Owner::vehicle, {}, 0),
             slot_b = graph.add_atom("b", Owner::vehicle, {}, 1);
  const auto slot = graph.define("f", Owner::vehicle, graph.parse({text, {1, 1}}, Owner::vehicle), {1, 1});
  ExpressionGraph::Evaluation e;
  graph.prepare(e, 2);
  e.value[static_cast<std::size_t>(slot_a)] = a;
  e.value[static_cast<std::size_t>(slot_b)] = b;
  graph.evaluate(Owner::vehicle, e, true);
  return {e.value[static_cast<std::size_t>(slot)], e.gradient.col(slot)};
}

TEST(Expression, PrecedenceIsThatOfMathematics) {
  const std::pair<const char*, double> cases[] = {{"2 + 3*4", 14},
                                                  {"2*3^2", 18},
                                                  {"-3^2", -9},
                                                  {"(-3)^2", 9},
                                                  {"2^3^2", 512},
                                                  {"2^-1", 0.5},
                                                  {"8/4/2", 1},
                                                  {"8/(4/2)", 4},
                                                  {"1 - 2 - 3", -4},
                                                  {"2 - -3", 5},
                                                  {"- -3", 3},
                                                  {"+3", 3},
                                                  {"-a^2", -9},
                                                  {"a - b*2", -1},
                                                  {"a/b*b", 3},
                                                  {".5*4", 2},
                                                  {"1e2 + 1.5E-1", 100.15},
                                                  {"2*pi", 2 * M_PI},
                                                  {"atan2(b, -a)", std::atan2(2, -3)},
                                                  {"sqrt(a^2)", 3},
                                                  {"abs(-b)", 2},
                                                  {"log(exp(a))", 3},
                                                  {"tanh(a)", std::tanh(3)},
                                                  {"a^b", 9},
                                                  {"2^(1/2)*2^0.5", 2},
                                                  {"0.1 + 0.2 - 0.3", 0},
                                                  {"1/3*3", 1},
                                                  {"a*-b - 1", -7},
                                                  {"b*-sin(a) + a", 3 - 2 * std::sin(3)},
                                                  {"2*-3 + 1", -5},
                                                  {"a - -b - 1", 4},
                                                  {"a/-b + 1", -0.5},
                                                  {"a^-b + 1", 10. / 9}};
  for (const auto& [text, value] : cases) EXPECT_NEAR(evaluate(text, 3, 2).value, value, 1e-14) << text;
}

/// A random expression and its value.
struct Sample {
  std::string text;
  double value;
};

Sample random_expression(RandomStream& random, int depth, double a, double b) {
  if (depth == 0) {
    if (random.below(3) == 0) return {"a", a};
    if (random.below(2) == 0) return {"b", b};
    const int n = 1 + random.below(9);
    return {std::to_string(n) + "/4", n / 4.0};
  }
  const Sample left = random_expression(random, depth - 1, a, b);
  const std::string inner = "(" + left.text + ")";
  switch (random.below(9)) {
    case 0:
      return {"sin" + inner, std::sin(left.value)};
    case 1:
      return {"exp(sin" + inner + ")", std::exp(std::sin(left.value))};
    case 2:
      return {"sqrt(1 + " + inner + "^2)", std::sqrt(1 + left.value * left.value)};
    case 3:
      return {"-" + inner, -left.value};
    default:
      break;
  }
  const Sample right = random_expression(random, depth - 1, a, b);
  const std::string other = "(" + right.text + ")";
  switch (random.below(5)) {
    case 0:
      return {inner + " + " + other, left.value + right.value};
    case 1:
      return {inner + " - " + other, left.value - right.value};
    case 2:
      return {inner + "*" + other, left.value * right.value};
    case 3:
      return {inner + "/(2 + cos" + other + ")", left.value / (2 + std::cos(right.value))};
    default:
      return {"atan2(2 + sin" + inner + ", " + other + ")",
              std::atan2(2 + std::sin(left.value), right.value)};
  }
}

TEST(Expression, ValueAndDerivativesAreCorrect) {
  RandomStream random(5, "expressions");
  for (int trial = 0; trial < 300; ++trial) {
    const double a = random.uniform(-2, 2), b = random.uniform(-2, 2);
    const Sample sample = random_expression(random, 4, a, b);
    const Evaluated f = evaluate(sample.text, a, b);
    ASSERT_NEAR(f.value, sample.value, 1e-12 * (1 + std::abs(sample.value))) << sample.text;
    const double step = 1e-5, scale = 1 + f.gradient.norm() + std::abs(f.value);
    const double da =
        (evaluate(sample.text, a + step, b).value - evaluate(sample.text, a - step, b).value) / (2 * step);
    const double db =
        (evaluate(sample.text, a, b + step).value - evaluate(sample.text, a, b - step).value) / (2 * step);
    ASSERT_NEAR(f.gradient[0], da, 1e-5 * scale * scale) << sample.text;
    ASSERT_NEAR(f.gradient[1], db, 1e-5 * scale * scale) << sample.text;
  }
}

TEST(Expression, PrintsInACanonicalOrder) {
  const GiNaC::realsymbol a("a"), b("b"), theta("theta");
  EXPECT_EQ(written(b - a), "b - a");
  EXPECT_EQ(written(a - b), "a - b");
  EXPECT_EQ(written(GiNaC::pow(a - b, -1)), written(-GiNaC::pow(b - a, -1)));
  EXPECT_EQ(written(a * GiNaC::sin(theta) / (GiNaC::pow(a, 2) + GiNaC::pow(b, 2))),
            "a*sin(theta)/(a^2 + b^2)");
  EXPECT_EQ(written(-a * GiNaC::cos(theta)), "-a*cos(theta)");
  EXPECT_EQ(written(GiNaC::numeric(2, 3) * a), "2*a/3");
  EXPECT_EQ(written(GiNaC::sqrt(a + b)), "sqrt(a + b)");
  EXPECT_EQ(written(GiNaC::pow(a * b, 2)), "a^2*b^2");
  EXPECT_EQ(written(1 / GiNaC::sqrt(a)), "1/sqrt(a)");
  EXPECT_EQ(written(GiNaC::ex(0)), "0");
  EXPECT_EQ(in_latex(a / b), "\\frac{a}{b}");
  EXPECT_EQ(in_latex(GiNaC::atan2(b, a) - theta), "\\operatorname{atan2}\\left(b, a\\right) - \\theta");
  EXPECT_EQ(in_latex(GiNaC::pow(GiNaC::abs(a) + 1, 2)), "\\left(1 + \\left|a\\right|\\right)^{2}");
}

TEST(LatexNames, AreTypesetAsInMathematics) {
  const std::pair<const char*, const char*> cases[] = {{"x", "x"},
                                                       {"xf", "x_{f}"},
                                                       {"xf1", "x_{f1}"},
                                                       {"theta", "\\theta"},
                                                       {"omega_dot", "\\omega_{\\mathit{dot}}"},
                                                       {"qex", "q_{ex}"},
                                                       {"c11", "c_{11}"},
                                                       {"hitch", "\\mathit{hitch}"},
                                                       {"hitch_1", "\\mathit{hitch}_{1}"},
                                                       {"v_in_x", "v_{in,x}"},
                                                       {"0", "0"}};
  for (const auto& [name, latex] : cases) EXPECT_EQ(latex_name(name), latex);
}

TEST(LatexNames, DistinctNamesAreTypesetDifferently) {
  const LatexNames names({"xf", "x_f", "x1", "x_1", "x", "x_", "pi_", "L"});
  EXPECT_EQ(names("xf"), "x_{f}");
  EXPECT_EQ(names("x_f"), "\\mathit{x\\_f}");
  EXPECT_EQ(names("x_1"), "\\mathit{x\\_1}");
  EXPECT_EQ(names("x_"), "\\mathit{x\\_}");
  EXPECT_EQ(names("pi_"), "\\mathit{pi\\_}");
  EXPECT_EQ(names("L_theta L_0(2) x_f"), "\\mathcal{L}_{\\theta} \\mathcal{L}_{{0^{(2)}}} \\mathit{x\\_f}");
  EXPECT_EQ(names("v(2)"), "{v^{(2)}}");
  // A derivative followed by another symbol needs a separator
  const GiNaC::realsymbol derivative("L_0 x"), L("L");
  EXPECT_EQ(in_latex(L * GiNaC::pow(derivative, 2), names), "L \\left(\\mathcal{L}_{0} x\\right)^{2}");
}

/// A printed expression parses to the same expression.
TEST(Expression, ParsesWhatItPrints) {
  RandomStream random(6, "round trip");
  for (int trial = 0; trial < 200; ++trial) {
    const double a = random.uniform(-2, 2), b = random.uniform(-2, 2);
    const Sample sample = random_expression(random, 4, a, b);
    ExpressionGraph graph;
    graph.add_atom("a", Owner::vehicle, {});
    graph.add_atom("b", Owner::vehicle, {});
    const std::string again = written(graph.parse({sample.text, {}}, Owner::vehicle));
    ASSERT_NEAR(evaluate(again, a, b).value, sample.value, 1e-12 * (1 + std::abs(sample.value)))
        << sample.text << "\n"
        << again;
  }
}

TEST(ExpressionGraph, DifferentiatesThroughDefinitions) {
  ExpressionGraph graph;
  const auto x = graph.add_atom("x", Owner::vehicle, {}, 0);
  graph.define("r", Owner::vehicle, graph.parse({"3 - x", {}}, Owner::vehicle), {}, true);
  graph.define("x", Owner::vehicle, graph.parse({"x + 7", {}}, Owner::vehicle), {});
  EXPECT_EQ(written(graph.parse({"2*x", {}}, Owner::vehicle)), "2*x");
  EXPECT_EQ(written(graph.derivative(graph.parse({"2*x", {}}, Owner::vehicle), x)), "2")
      << "the state, not its result";
  const auto z = graph.define("z", Owner::landmark, graph.parse({"r^2", {}}, Owner::vehicle), {});
  EXPECT_EQ(written(graph.derivative(*graph[z].expression, x)), "-2*r");
  EXPECT_EQ(graph.find("z", Owner::anchor), std::nullopt) << "anchors have none of the landmark's states";
  EXPECT_EQ(graph.find("r", Owner::anchor), 1);
}

}  // namespace
}  // namespace incognita
