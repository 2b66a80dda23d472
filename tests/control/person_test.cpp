// A person in place of the controller: late, imprecise, sometimes wrong, and by the seed always the same.
#include "incognita/control/person.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace incognita {
namespace {

const Eigen::Vector3d here(1, 2, 1.2);

PersonSettings exact() {
  PersonSettings s;
  s.holds = true;
  s.delay_s = s.sigma_way_ratio = 0;
  return s;
}

Way shown_at(double t, const Eigen::Vector3d& way) { return {here, here + way, t, t + 1}; }

TEST(Person, DoesWhatIsShownFromWhereTheCameraIs) {
  Person person(exact(), 1, "person");
  const Eigen::Vector3d at(5, 5, 1);
  const Way doing = person.obey(shown_at(3, {0.3, 0, 0}), true, at, 3);
  EXPECT_EQ(doing.from, at);
  EXPECT_NEAR((doing.to - at - Eigen::Vector3d(0.3, 0, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(doing.start_t, 3);
  EXPECT_EQ(doing.end_t, 4);
}

TEST(Person, StandsUntilTheDelayHasPassedAndThenDoesItAll) {
  PersonSettings s = exact();
  s.delay_s = 0.4;
  Person person(s, 1, "person");
  const Way shown = shown_at(0, {0, 0.3, 0});
  for (int i = 0; i < 8; ++i) {
    const Way doing = person.obey(shown, i == 0, here, i * 0.05);
    EXPECT_EQ(doing.from, doing.to) << "still standing after " << i * 0.05 << " s";
  }
  const Way doing = person.obey(shown, false, here, 0.4);
  EXPECT_NEAR((doing.to - here - Eigen::Vector3d(0, 0.3, 0)).norm(), 0, 1e-12);
  EXPECT_DOUBLE_EQ(doing.end_t, 1.4);
}

TEST(Person, WhoIsLaterThanAPeriodDoesOneAfterTheOther) {
  PersonSettings s = exact();
  s.delay_s = 1.5;
  Person person(s, 1, "person");
  person.obey(shown_at(0, {0.3, 0, 0}), true, here, 0);
  person.obey(shown_at(1, {0, 0, 0.3}), true, here, 1);
  EXPECT_NEAR(person.obey(shown_at(1, {0, 0, 0.3}), false, here, 1.5).to.x(), here.x() + 0.3, 1e-12);
  EXPECT_NEAR(person.obey(shown_at(1, {0, 0, 0.3}), false, here, 2.5).to.z(), here.z() + 0.3, 1e-12);
}

/// Of a wrong way nothing is left of the right one but its length: the five others are equally likely.
TEST(Person, WhoErrsGoesAnotherWayOfTheSameLengthAsOftenAsTold) {
  PersonSettings s = exact();
  s.wrong = 0.25;
  for (const Eigen::Vector3d& way : {Eigen::Vector3d(0.3, 0, 0), Eigen::Vector3d(0, 0, -0.3)}) {
    Person person(s, 7, "person");
    int wrong = 0, back = 0;
    constexpr int times = 4000;
    for (int i = 0; i < times; ++i) {
      const Way doing = person.obey(shown_at(i, way), true, here, i);
      const Eigen::Vector3d gone = doing.to - doing.from;
      EXPECT_NEAR(gone.norm(), 0.3, 1e-12);
      wrong += (gone - way).norm() > 1e-9;
      back += (gone + way).norm() < 1e-9;
    }
    EXPECT_NEAR(wrong, times * 0.25, 4 * std::sqrt(times * 0.25 * 0.75));
    EXPECT_NEAR(back, times * 0.05, 4 * std::sqrt(times * 0.05 * 0.95));
  }
}

TEST(Person, StaysWhereItIsToldTo) {
  PersonSettings s = exact();
  s.wrong = 1;
  Person person(s, 1, "person");
  const Way doing = person.obey(shown_at(0, {0, 0, 0}), true, here, 0);
  EXPECT_EQ(doing.from, doing.to);
}

TEST(Person, OfOneSeedIsTheSameAndOfAnotherIsNot) {
  PersonSettings s = exact();
  s.sigma_way_ratio = 0.2;
  const auto gone = [&](std::uint64_t seed) {
    Person person(s, seed, "person");
    std::vector<double> ways;
    for (int i = 0; i < 5; ++i) {
      const Way doing = person.obey(shown_at(i, {0.3, 0, 0}), true, here, i);
      ways.push_back((doing.to - doing.from).norm());
    }
    return ways;
  };
  EXPECT_EQ(gone(3), gone(3));
  EXPECT_NE(gone(3), gone(4));
}

TEST(Person, RefusesWhatCanNotBe) {
  PersonSettings s = exact();
  s.wrong = 1.5;
  EXPECT_THROW(Person(s, 1, "person"), std::invalid_argument);
  s = exact();
  s.delay_s = -1;
  EXPECT_THROW(Person(s, 1, "person"), std::invalid_argument);
}

TEST(Person, WhoForgetsDoesNothingThatWasShownBefore) {
  PersonSettings s = exact();
  s.delay_s = 0.5;
  Person person(s, 1, "person");
  const Eigen::Vector3d there(4, 5, 6);
  person.obey({{0, 0, 0}, {1, 0, 0}, 0, 1}, true, {0, 0, 0}, 0);
  person.forget();
  const Way after = person.obey({{0, 0, 0}, {1, 0, 0}, 0, 1}, false, there, 2);
  EXPECT_EQ(after.from, there);
  EXPECT_EQ(after.to, there);
}

}  // namespace
}  // namespace incognita
