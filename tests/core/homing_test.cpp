// Homing as a program does it, with switches and small steps only: from every posture with the tool
// down the Rhino ends exactly at the same hard home.
#include <gtest/gtest.h>

#include <deque>
#include <string>

#include "core/kinematics.hpp"
#include "core/stall.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::LabelledCount;
using test::Rig;

// Uses only what a line provides: the reply to ?, and the bit of a switch.
class Homing {
 public:
  explicit Homing(Rig& rig) : rig_(rig) {}

  /// Homes every joint in turn; a blocked one is retried after the others have moved. Returns false
  /// if all are blocked.
  bool home(std::deque<char> labels) {
    for (std::size_t put_off = 0; !labels.empty();) {
      if (put_off > labels.size()) return false;
      const char label = labels.front();
      labels.pop_front();
      const bool found = home_one(label);
      if (!found) labels.push_back(label);
      put_off = found ? 0 : put_off + 1;
    }
    return true;
  }

 private:
  static int towards(char label) { return label == 'E' || label == 'B' ? -1 : 1; }

  bool home_one(char label) {
    const int way = towards(label);
    return step_while(label, true, -5 * way) && step_while(label, false, 5 * way) &&
           step_while(label, true, -way) && step_while(label, false, way);
  }

  bool step_while(char label, bool closed, int counts) {
    for (int steps = 0; is_closed(label) == closed; ++steps) {
      if (steps > 1000 || !step(label, counts)) return false;
    }
    return true;
  }

  bool is_closed(char label) {
    return std::get<SwitchState>(rig_.execute(QuerySwitch{label})).closed;
  }
  int to_go(char label) { return std::get<ErrorMagnitude>(rig_.execute(QueryError{label})).counts; }

  // If the reply is unchanged for 100 ms, the joint is blocked.
  bool step(char label, int counts) {
    rig_.move(label, counts);
    for (int before = to_go(label); before != 0;) {
      rig_.pass(100);
      const int now = to_go(label);
      if (now == before) {
        rig_.execute(Stop{label});
        return false;
      }
      before = now;
    }
    return true;
  }

  Rig& rig_;
};

constexpr LabelledCount kHardHome[] = {{'F', 30}, {'E', -40}, {'D', 40}, {'C', 40}, {'B', -25}};

struct StartPosture {
  std::initializer_list<LabelledCount> counts;
};

// Tool down is C = 0, because coupling keeps the hand's orientation.
const StartPosture kStartPostures[] = {
    {{}},
    {{{'E', 449}, {'D', -625}}},
    {{{'F', 71}, {'E', 543}, {'D', -479}, {'B', 260}}},
    {{{'F', -66}, {'E', 559}, {'D', -455}, {'B', -208}}},
    {{{'F', 144}, {'E', 460}, {'D', -655}, {'B', 201}}},
    {{{'F', -138}, {'E', 445}, {'D', -649}, {'B', 156}}},
    {{{'E', 242}, {'D', -440}}},
    {{{'F', 700}, {'E', 300}, {'D', -300}, {'B', -300}}},
    {{{'F', -700}, {'E', 100}, {'D', 300}}},
    {{{'E', 850}, {'D', -300}}},
    {{{'E', 600}, {'D', 100}, {'B', 500}}},
    {{{'E', -40}, {'D', 40}, {'F', 30}, {'B', -25}}},
};

TEST(Homing, EndsAtTheHardHomeFromEveryPostureWithTheToolDown) {
  for (const StartPosture& posture : kStartPostures) {
    Rig rig;
    rig.stand_at(posture.counts);
    const State start = rig.state();
    ASSERT_TRUE(Homing(rig).home({'D', 'E', 'C', 'B', 'F'}));
    EXPECT_EQ(rig.state().stall, Stall::kNo);
    for (const auto& [label, count] : kHardHome) {
      EXPECT_EQ(rig.count(label), count) << label << " from " << test::words(start);
    }
    EXPECT_EQ(rig.execute(QuerySwitchesI{}), Reply(SwitchBits{15, 15, 0, 'I'}));
  }
}

// A posture is reachable if it is outside the region, above the table and within limits.
bool is_reachable(const Model& model, const Positions& at) {
  for (int i = 0; i < model.motor_count(); ++i) {
    const Counts position = at[static_cast<std::size_t>(i)];
    if (position < model.motor(i).low || position > model.motor(i).high) return false;
  }
  const PointUm tip = tool_tip(model, at);
  return !is_in_protected_region(model, at, tip) && !is_below_surface(model, tip);
}

// If the upper arm leans back by more than about 32 degrees (E below -280) and the hand is high,
// the elbow's way home leads through the protected region: a program must then move the shoulder
// first.
TEST(Homing, EndsAtTheHardHomeFromAGridOfArmPostures) {
  int postures = 0;
  for (Counts e = -275; e <= 850; e += 125) {
    for (Counts d = -650; d <= 900; d += 125) {
      Rig rig;
      rig.stand_at({{'E', e}, {'D', d}});
      if (!is_reachable(rig.model(), positions(rig.model(), rig.state().motors))) continue;
      ++postures;
      EXPECT_TRUE(Homing(rig).home({'D', 'E', 'C', 'B', 'F'})) << "E " << e << " D " << d;
      EXPECT_EQ(rig.count('E'), -40) << "E " << e << " D " << d;
      EXPECT_EQ(rig.count('D'), 40) << "E " << e << " D " << d;
      EXPECT_EQ(rig.count('C'), 40) << "E " << e << " D " << d;
    }
  }
  EXPECT_GT(postures, 20);
}

TEST(Homing, TheHardHomeIsWithinLimitsAndOutsideTheRegion) {
  for (const char* name : {"rhino-xr3", "adept-one", "intelledex-660"}) {
    const ModelPtr model = test::model_of(test::robot_named(name));
    State state = initial_state(*model);
    for (int i = 0; i < model->motor_count(); ++i) {
      state.motor(i).count = model->motor(i).drive.microswitch.position;
    }
    const Positions at = positions(*model, state.motors);
    EXPECT_TRUE(is_reachable(*model, at)) << name;
  }
}

}  // namespace
}  // namespace xr3
