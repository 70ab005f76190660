// The process: one io_context, the cells, their ports, signals, and an orderly shutdown.
//
// The flow through server: main.cpp makes an App from options (options/), loaded models
// (files/load_model.hpp) and a token. The App divides descriptors and memory (net/), opens the
// cells and gives each its ports. Bytes reach a robot through robot_port/ (TCP), pty/
// (pseudo-terminals) or device/ (a physical controller). lines/ serves the lines in turn, executes
// their bytes on the cell and writes the replies. A cell is hosted by cells/, with the timers that
// advance it by wall time when no input does. On the other port, monitor_port/ has the transports
// of JSON clients, session/ their state, service/ their requests, and resources/ and http/ serve
// browsers. recording/ writes the inputs of a cell to a file. All runs in one thread, in the event
// loop of run(), except for long work, such as a picture (net/worker.hpp), and the transfer of
// pseudo-terminals. A signal, or the end of standard input, ends it: ports are closed, lines and
// connections get a second to drain, and recordings and port file are finished.
#pragma once

#include <boost/asio/signal_set.hpp>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "server/cells/branch_cells.hpp"
#include "server/cells/comebacks.hpp"
#include "server/cells/connection_cells.hpp"
#include "server/cells/registry.hpp"
#include "server/cells/seed.hpp"
#include "server/cells/student_machines.hpp"
#include "server/files/port_file.hpp"
#include "server/lines/turns.hpp"
#include "server/monitor_port/port.hpp"
#include "server/net/asio.hpp"
#include "server/net/memory_limit.hpp"
#include "server/net/service_manager.hpp"
#include "server/net/socket_limits.hpp"
#include "server/options/options.hpp"
#include "server/recording/retention.hpp"
#include "server/recording/room.hpp"
#include "server/session/access.hpp"

namespace xr3 {

/// Time for which cells of connections, and branches, are kept without use.
WallNs linger_of(const ServeOptions& options);

class App {
 public:
  /// `seeds`: of the cells of plan_cells(), and with --cell-per-connection one for those of
  /// connections.
  /// `token`: as read from the source in the options; empty if there is none. Throws CellPlanError.
  App(const ServeOptions& options, std::vector<CellSeed> seeds, std::string token);

  App(const App&) = delete;
  App& operator=(const App&) = delete;
  ~App();

  /// Lets `replay` apply inputs to the first cell, which is fresh, to make the state with which
  /// this server begins. Closes its lines after it, and does not log its events.
  void begin_with(const std::function<void(Cell&)>& replay);

  /// Serves until SIGTERM, SIGINT or SIGHUP, or with --until-stdin-ends the end of standard input,
  /// then sends pending replies and returns kGood. An exception from any loop or handler ends it at
  /// once: it is logged, and the result is kBroken.
  /// Throws ExitError if it cannot listen on a port; FileError if a file or pseudo-terminal cannot
  /// be made.
  ExitCode run();

  /// Valid once run() has begun to serve.
  tcp::endpoint robot_endpoint() const;
  tcp::endpoint monitor_endpoint() const { return monitor_port_.endpoint(); }
  /// The executor for posting work to the event loop.
  asio::io_context::executor_type executor() { return io_.get_executor(); }

 private:
  ExitCode serve();
  ExitCode break_off(const char* what);
  void listen();
  void open_terminals();
  void connect_device();
  void start_recordings();
  void start_recording_of_one();
  void start_recordings_of_class();
  void record(HostedCell& cell);
  void record_or_report(HostedCell& cell);
  void begin_again(HostedCell& cell);
  void keep_histories();
  void keep_history(HostedCell& cell);
  std::variant<CellPtr, call::Refused> open_branch(HostedCell& of, MachineSnapshotPtr past);
  CellPtr make_branch(const std::string& name, HostedCell& of, const MachineSnapshot& past);
  void begin_branch(HostedCell& cell, MachineSnapshotPtr past);
  void open_device();
  void announce();
  void announce_token() const;
  void announce_page() const;
  void await_signal();
  asio::awaitable<void> await_end_of_input();
  void stop();
  void end_soon();
  HostedCell& first() const { return *cells_.all().front(); }
  void check_byte_clock() const;
  void open_planned();
  void serve_connections();
  CellPtr make_cell(const std::string& name, const CellSeed& seed, std::string token);
  CellPtr open_for_connection(const std::string& name);
  void close_cell(const CellPtr& cell);
  std::size_t lines_per_cell() const;
  std::size_t lines_of_connections() const;
  RobotPortRules port_rules(std::size_t lines) const;
  void listen_on_cell(HostedCell& cell, std::uint16_t port);
  ServedPorts served_ports() const;
  void count_more(CellCounters& counters);
  void after_input(HostedCell& cell);
  void ended();
  bool has_no_clients() const;
  std::size_t close_greediest();
  std::size_t trim_frames();
  std::string not_ready() const;

  enum class Stage : std::uint8_t { kStarting, kReady, kDraining, kEnded };

  ServeOptions options_;
  std::vector<CellPlan> plans_;
  std::vector<CellSeed> seeds_;
  std::string fresh_token_;  ///< generated for this run, to be printed; else empty
  /// Freed before a failure is logged, since memory may be exhausted.
  std::unique_ptr<char[]> reserve_;
  EventLoop io_;
  Stage stage_ = Stage::kStarting;
  bool is_replaying_ = false;
  std::string page_;         ///< address of the page; empty before the monitor port listens
  std::string record_path_;  ///< path of the recording; empty for several cells
  AccessPolicy policy_;
  RecordingRoom record_room_;
  SocketLimits limits_;
  MemoryLimit memory_;
  monitor::ByteBudget rings_;
  monitor::ByteBudget histories_;
  LineTurns turns_{io_};
  Worker worker_;
  CellContext context_;
  CellRegistry cells_;
  Comebacks comebacks_;
  Retention retention_;
  StudentMachines student_machines_;
  std::optional<ConnectionCells> connection_cells_;
  MonitorPort monitor_port_;
  BranchCells branch_cells_;
  ServiceManager service_manager_;
  asio::signal_set signals_;
  std::optional<PortFile> port_file_;
  asio::steady_timer drain_limit_{io_};
};

}  // namespace xr3
