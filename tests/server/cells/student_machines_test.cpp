// The machines on which students have opened their pages.
#include "server/cells/student_machines.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace xr3 {
namespace {

asio::ip::address machine(std::uint32_t number) { return asio::ip::address_v4(number); }

TEST(StudentMachines, TheLastPageOfAMachineCounts) {
  StudentMachines machines;
  EXPECT_EQ(machines.cell_on(machine(1)), std::nullopt);
  machines.note(machine(1), "ada");
  machines.note(machine(2), "bob");
  EXPECT_EQ(machines.cell_on(machine(1)), "ada");
  machines.note(machine(1), "eve");
  EXPECT_EQ(machines.cell_on(machine(1)), "eve");
  EXPECT_EQ(machines.cell_on(machine(2)), "bob");
}

TEST(StudentMachines, TheOldestIsForgotten) {
  StudentMachines machines;
  for (std::uint32_t i = 0; i < StudentMachines::kMost; ++i) machines.note(machine(i), "ada");
  machines.note(machine(0), "ada");
  machines.note(machine(StudentMachines::kMost), "ada");
  EXPECT_EQ(machines.cell_on(machine(0)), "ada");
  EXPECT_EQ(machines.cell_on(machine(1)), std::nullopt);
  EXPECT_EQ(machines.cell_on(machine(2)), "ada");
}

}  // namespace
}  // namespace xr3
