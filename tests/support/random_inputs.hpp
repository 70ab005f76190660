// Random inputs of a cell at random wall times: lines, bytes, calls, faults.
#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "cell/cell.hpp"

namespace xr3::test {

class RandomInputs {
 public:
  RandomInputs(Cell& cell, std::uint32_t seed) : cell_(cell), random_(seed) {}

  /// Lets time pass and applies an input, so many times.
  void play(int inputs);
  WallNs now() const { return now_; }

 private:
  std::uint32_t below(std::uint32_t end);
  void pass();
  void act();
  void open();
  LineId some_line();
  void close();
  void take();
  std::string bytes();
  void send();
  void call();

  Cell& cell_;
  std::mt19937 random_;
  WallNs now_ = 0;
};

}  // namespace xr3::test
