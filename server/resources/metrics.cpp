#include "server/resources/metrics.hpp"

#include <prometheus/metric_family.h>
#include <prometheus/text_serializer.h>

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "protocol/explain/command_text.hpp"
#include "protocol/explain/event_report.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/text/text_stream.hpp"

namespace xr3 {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;

/// The label of a command; one label for commands with several codes.
std::string kind_of(const Command& command) {
  if (std::holds_alternative<SetAuxiliary>(command)) return "auxiliary";
  if (std::holds_alternative<SetOutput>(command)) return "output";
  return std::string(code_of(command));
}

template <std::size_t... Index>
std::vector<std::string> kinds(std::index_sequence<Index...>) {
  return {kind_of(Command(std::in_place_index<Index>))...};
}

/// The labels of the commands, by index in Command.
const std::vector<std::string>& command_kinds() {
  static const auto names = kinds(std::make_index_sequence<kCommandKinds>());
  return names;
}

/// Builds the metric families, of one cell unless they are of the process.
class MetricsPage {
 public:
  explicit MetricsPage(const std::string& cell) : cell_(cell) {}

  void counter(const std::string& name, const std::string& help, double value) {
    begin(name, help, MetricType::Counter);
    add({}, value);
  }
  void gauge(const std::string& name, const std::string& help, double value) {
    begin(name, help, MetricType::Gauge);
    add({}, value);
  }
  void begin(const std::string& name, const std::string& help, MetricType type) {
    families_.push_back({"xr3_" + name, help, type, {}});
  }
  /// Adds a sample to the family of the last begin().
  void add(std::vector<ClientMetric::Label> labels, double value) {
    ClientMetric metric;
    metric.label = std::move(labels);
    if (!cell_.empty()) metric.label.insert(metric.label.begin(), {"cell", cell_});
    metric.counter.value = value;
    metric.gauge.value = value;
    families_.back().metric.push_back(std::move(metric));
  }
  /// A metric with the name that Prometheus prescribes for every process; without a label.
  template <class Value>
  void of_process(const std::string& name, const std::string& help, MetricType type,
                  std::optional<Value> value) {
    if (!value) return;
    ClientMetric metric;
    metric.counter.value = metric.gauge.value = static_cast<double>(*value);
    families_.push_back({"process_" + name, help, type, {std::move(metric)}});
  }
  std::string text() const {
    TextStream out;
    prometheus::TextSerializer().Serialize(out, families_);
    return out.str();
  }

 private:
  std::string cell_;
  std::vector<MetricFamily> families_;
};

std::string channel_name(std::size_t index) {
  return std::string(monitor::name_of(static_cast<monitor::Channel>(index)));
}

double number(std::uint64_t count) { return static_cast<double>(count); }

double seconds(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

void add_lines(MetricsPage& page, const CellCounters& counters) {
  page.gauge("lines_open", "Open serial lines.", number(counters.lines_open));
  page.gauge("lines_max", "Serial lines that may be open (--max-lines).",
             number(counters.lines_max));
  page.counter("lines_total", "Serial lines opened since the start.", number(counters.lines_total));
  page.begin("lines_closed_total", "Serial lines closed, by reason.", MetricType::Counter);
  for (std::size_t i = 0; i < kLineCloseReasons; ++i) {
    const std::string_view reason = code_of(static_cast<LineCloseReason>(i));
    page.add({{"reason", std::string(reason)}}, number(counters.lines_closed.at(i)));
  }
  page.counter("bytes_in_total", "Bytes received on serial lines.", number(counters.bytes_in));
  page.counter("bytes_out_total", "Bytes sent on serial lines.", number(counters.bytes_out));
}

void add_cells(MetricsPage& page, const CellCounters& counters) {
  page.gauge("cells", "Open cells.", number(counters.cells_open));
  page.counter("cells_opened_total", "Cells opened since the start.", number(counters.cells_total));
}

void add_commands(MetricsPage& page, const CellCounters& counters) {
  page.begin("commands_total", "Commands executed, by kind.", MetricType::Counter);
  for (std::size_t i = 0; i < kCommandKinds; ++i)
    page.add({{"kind", command_kinds()[i]}}, number(counters.commands.at(i)));
  page.begin("warnings_total", "Problems and warnings, by code.", MetricType::Counter);
  for (const auto& [code, count] : counters.warnings)
    page.add({{"code", std::string(code)}}, number(count));
}

void add_time(MetricsPage& page, const CellCounters& counters) {
  page.counter("ticks_total", "Ticks simulated, over all epochs.", number(counters.ticks));
  page.counter("simulated_seconds_total", "Seconds simulated, over all epochs.",
               number(counters.ticks) / kTickHz);
}

void add_recordings(MetricsPage& page, const CellCounters& counters) {
  page.counter("recordings_failed_total", "Recordings that ended before their cells.",
               number(counters.recordings_failed));
  if (counters.recording_room)
    page.gauge("recording_room_bytes", "Bytes that recordings may still have.",
               number(*counters.recording_room));
}

void add_memory(MetricsPage& page, const CellCounters& counters) {
  page.gauge("allocated_bytes", "Memory that the server has allocated.",
             number(counters.allocated_bytes));
  page.gauge("allocated_max_bytes", "Memory beyond which clients are closed (--max-memory).",
             number(counters.allocated_max));
}

void add_refusals(MetricsPage& page, const CellCounters& counters) {
  const PortCounters& robot = counters.robot_port;
  const PortCounters& monitor = counters.monitor_port;
  page.counter("lines_refused_total", "Connections of the robot port beyond its limit of lines.",
               number(robot.refused));
  page.counter("other_peers_total",
               "Connections of a robot port that belongs to another address (--bind-peer).",
               number(robot.other_peers));
  page.counter("viewers_refused_total", "Connections of the monitor port beyond its limit.",
               number(monitor.refused));
  page.begin("accept_failures_total", "Failed attempts to accept a connection, by port.",
             MetricType::Counter);
  page.add({{"port", "robot"}}, number(robot.accept_failures));
  page.add({{"port", "monitor"}}, number(monitor.accept_failures));
}

void add_process(MetricsPage& page, const CellCounters& counters, const ProcessStats& process) {
  page.gauge("event_loop_lag_seconds", "Greatest delay of the event loop in the last minute.",
             seconds(counters.loop_lag_ns));
  page.of_process("cpu_seconds_total", "User and system CPU time in seconds.", MetricType::Counter,
                  process.cpu_s);
  page.of_process("resident_memory_bytes", "Resident memory in bytes.", MetricType::Gauge,
                  process.resident_bytes);
  page.of_process("open_fds", "Open file descriptors.", MetricType::Gauge,
                  process.open_descriptors);
  page.of_process("max_fds", "Maximum number of open file descriptors.", MetricType::Gauge,
                  process.max_descriptors);
}

void add_sessions(MetricsPage& page, const CellCounters& counters) {
  page.gauge("viewers", "Connected monitor clients.", number(counters.monitor_sessions));
  page.counter("wrong_tokens_total", "Wrong tokens that clients gave.",
               number(counters.wrong_tokens));
  page.begin("frames_sent_total", "Messages sent to clients, by channel.", MetricType::Counter);
  for (std::size_t i = 0; i < kChannels; ++i)
    page.add({{"channel", channel_name(i)}}, number(counters.channels.at(i).sent));
  page.begin("frames_overwritten_total", "Messages that slow clients missed, by channel.",
             MetricType::Counter);
  for (std::size_t i = 0; i < kChannels; ++i)
    page.add({{"channel", channel_name(i)}}, number(counters.channels.at(i).overwritten));
}

}  // namespace

std::string metrics_text(const std::string& cell, const CellCounters& counters,
                         const ProcessStats& process) {
  MetricsPage page(cell);
  add_cells(page, counters);
  add_lines(page, counters);
  add_commands(page, counters);
  add_time(page, counters);
  add_recordings(page, counters);
  add_sessions(page, counters);
  add_refusals(page, counters);
  add_memory(page, counters);
  add_process(page, counters, process);
  return page.text();
}

}  // namespace xr3
