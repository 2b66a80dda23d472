// What is saved is restored bit by bit, and nothing that is damaged is taken for a state or allocates without limit.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "incognita/math/chart.hpp"
#include "incognita/math/random.hpp"
#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/math/saved_state/saved_part.hpp"
#include "incognita/math/small_matrix.hpp"

namespace incognita {
namespace {

template <class... Values>
std::string saved(Values&... values) {
  StateWriter writer;
  StateArchive{writer}(values...);
  return writer.take();
}

template <class... Values>
void restore(const std::string& bytes, Values&... values) {
  StateReader reader(bytes);
  StateArchive{reader}(values...);
  EXPECT_EQ(reader.left(), 0u);
}

TEST(SavedState, AStreamGoesOnWhereItWas) {
  for (const int drawn : {0, 1, 2, 3, 311, 312, 313, 1001}) {
    RandomStream stream(7, "a"), other(8, "b");
    for (int i = 0; i < drawn; ++i) stream.normal();  // an odd number leaves a spare one
    restore(saved(stream), other);
    for (int i = 0; i < 1000; ++i) ASSERT_EQ(stream.normal(), other.normal()) << drawn << ", " << i;
    EXPECT_EQ(stream.bits(), other.bits());
  }
}

TEST(SavedState, ADamagedStreamIsRefused) {
  RandomStream stream(7, "a");
  std::string words = "1 2 three";
  double spare = 0;
  bool has_spare = false;
  EXPECT_THROW(restore(saved(words, spare, has_spare), stream), DamagedState);
}

TEST(SavedState, ValuesKeepTheirBits) {
  Eigen::Vector3d fixed(0.1, -0.0, std::numeric_limits<double>::denorm_min()), fixed_again;
  SmallMatrix small = SmallMatrix::Random(3, 5), small_again;
  SmallVector none, none_again = SmallVector::Ones(4);
  Eigen::MatrixXd large = Eigen::MatrixXd::Random(7, 11), large_again;
  std::optional<double> unknown = std::numeric_limits<double>::quiet_NaN(), unknown_again, empty,
                        empty_again = 3;
  std::map<int, std::vector<bool>> nested{{1, {true, false}}, {-4, {}}}, nested_again{{9, {}}};
  restore(saved(fixed, small, none, large, unknown, empty, nested), fixed_again, small_again, none_again,
          large_again, unknown_again, empty_again, nested_again);
  EXPECT_EQ(std::memcmp(&fixed, &fixed_again, sizeof fixed), 0);
  EXPECT_EQ(small, small_again);
  EXPECT_EQ(none_again.size(), 0);
  EXPECT_EQ(large, large_again);
  EXPECT_TRUE(unknown_again && *unknown_again != *unknown_again);
  EXPECT_FALSE(empty_again);
  EXPECT_EQ(nested, nested_again);
}

TEST(SavedState, AChartKeepsItsParts) {
  Chart chart{{Chart::Kind::line, 3}, {Chart::Kind::quaternion, 4}, {Chart::Kind::angle, 1}},
      again = Chart::line(2);
  restore(saved(chart), again);
  EXPECT_EQ(again.ambient(), 8);
  EXPECT_EQ(again.tangent(), 7);
  std::vector<double> x{0, 0, 0, 1, 0, 0, 0, 3.1}, delta(7, 0.1);
  std::vector<double> y = x;
  chart.plus(x, delta);
  again.plus(y, delta);
  EXPECT_EQ(x, y);
}

TEST(SavedState, AChartOfTooManyPartsIsRefused) {
  int parts = 5;
  Chart chart = Chart::line(1);
  EXPECT_THROW(restore(saved(parts), chart), DamagedState);
}

/// Announced sizes are compared with the bytes that are left, before anything is allocated.
TEST(SavedState, AnAbsurdSizeAllocatesNothing) {
  for (const std::uint64_t size : {std::uint64_t{3}, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    std::uint64_t announced = size;
    const std::string bytes = saved(announced);
    std::vector<double> numbers;
    std::string text;
    std::map<int, int> map;
    EXPECT_THROW(restore(bytes, numbers), DamagedState);
    EXPECT_THROW(restore(bytes, text), DamagedState);
    EXPECT_THROW(restore(bytes, map), DamagedState);
  }
}

TEST(SavedState, AMatrixThatDoesNotFitIsRefused) {
  const auto sizes = [](std::int64_t rows, std::int64_t columns) {
    std::string bytes = saved(rows, columns);
    return bytes + std::string(800, '\0');
  };
  Eigen::Matrix3d fixed;
  SmallVector small;
  Eigen::MatrixXd any;
  EXPECT_THROW(restore(sizes(3, 4), fixed), DamagedState);
  EXPECT_THROW(restore(sizes(17, 1), small), DamagedState);
  EXPECT_THROW(restore(sizes(1, 2), small), DamagedState);
  EXPECT_THROW(restore(sizes(-1, 1), any), DamagedState);
  EXPECT_THROW(restore(sizes(11, 11), any), DamagedState);
  EXPECT_THROW(restore(sizes(std::int64_t{1} << 33, std::int64_t{1} << 33), any), DamagedState);
}

TEST(SavedState, AByteThatIsNoBoolIsRefused) {
  std::uint8_t byte = 2;
  bool value = false;
  EXPECT_THROW(restore(saved(byte), value), DamagedState);
}

TEST(SavedState, EveryTruncationIsRefused) {
  RandomStream stream(7, "a");
  std::vector<Eigen::MatrixXd> matrices(3, Eigen::MatrixXd::Random(2, 3));
  const std::string bytes = saved(stream, matrices);
  for (std::size_t size = 0; size < bytes.size(); size += size < 6000 ? 97 : 1)
    EXPECT_THROW(restore(bytes.substr(0, size), stream, matrices), DamagedState) << size;
}

TEST(SavedState, APartThatDoesNotKnowItsStateSaysSo) {
  struct Silent final : SavedPart {
  } silent;
  StateWriter writer;
  StateArchive archive(writer);
  EXPECT_THROW(silent.state(archive), CannotBeSaved);
}

}  // namespace
}  // namespace incognita
