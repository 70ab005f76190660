// The faults of a machine: set and cleared, begun and ended at their ticks. A tick at which a
// fault begins or ends is a stop of the advance of time (step.hpp), so that nothing happens at
// rest in between.
#pragma once

#include <string_view>

#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Events of effects of one fault in a simulated second. More effects only count.
inline constexpr std::uint32_t kMaxFaultNews = 64;

/// Replaces all faults by those of a plan, without a history. Emits what begins at once.
void install_faults(const Model& model, State& state, const FaultPlan& plan, Events& events);

/// Adds a fault, or replaces the one with its name. A tick in the past means now. Preconditions:
/// the joint exists, and there are fewer than kMaxFaults or one with this name.
void set_fault(const Model& model, State& state, Fault fault, Events& events);

/// Removes the fault with this name, or all of them if it is empty. Returns whether there was one.
bool clear_faults(const Model& model, State& state, std::string_view name, Events& events);

/// nullptr if there is none with this name.
const FaultState* find_fault(const State& state, std::string_view name);

/// Recomputes the derived part of the faults, for a state from outside. Invariant: it changes no
/// state that was reached by step() and the functions above.
void refresh_faults(const Model& model, State& state);

/// Begins and ends the faults for which it is time. To be called in each tick that is a stop.
void pass_fault_stop(const Model& model, State& state, Events& events);

/// Counts an effect and appends its event. `at`: see FaultNews.
void add_effect(const Model& model, State& state, FaultState& fault, char label, std::int64_t at,
                Events& events);

/// Whether a fault acts now, on an occasion with these two numbers (see chance.hpp). Not for faults
/// that last.
bool acts_on(const State& state, const FaultState& fault, std::uint64_t first,
             std::uint64_t second);

}  // namespace xr3
