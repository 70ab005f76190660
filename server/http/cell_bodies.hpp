// The bodies of the HTTP resources of one cell, each made again only when it has changed.
#pragma once

#include <array>
#include <map>
#include <memory>

#include "cell/cell.hpp"
#include "protocol/monitor/message.hpp"
#include "server/http/body.hpp"
#include "server/http/body_maker.hpp"
#include "server/net/asio.hpp"
#include "server/net/exclusive.hpp"
#include "server/net/worker.hpp"

namespace xr3::http {

class CellBodies {
 public:
  using Revision = std::uint64_t;  ///< of the cell

  CellBodies(asio::io_context& io, Worker& worker)
      : bitmap(io, worker),
        png(io, worker),
        workcell(io, worker),
        robot(io, worker),
        io_(io),
        worker_(worker),
        copying_(io) {}

  /// The maker of the view from a point. At most kMaxViews are kept: one more discards all that
  /// nobody waits for.
  std::shared_ptr<BodyMaker<Revision>> view(const ViewVector& from) {
    if (views_.size() >= kMaxViews) views_.clear();
    auto& maker = views_[{from.x, from.y, from.z}];
    if (!maker) maker = std::make_shared<BodyMaker<Revision>>(io_, worker_);
    return maker;
  }
  /// The body with the text of this message of the channel `state`. A long text is copied in the
  /// worker's thread.
  asio::awaitable<Body> state(monitor::Message message);
  static constexpr std::size_t kMaxCopiedAtOnce = std::size_t{32} * 1024;

  BodyMaker<ImagePtr> bitmap;
  BodyMaker<ImagePtr> png;
  BodyMaker<Revision> workcell;
  BodyMaker<const Robot*> robot;

 private:
  static constexpr std::size_t kMaxViews = 8;

  asio::io_context& io_;
  Worker& worker_;
  Exclusive copying_;
  monitor::Message state_of_;  ///< the message whose text is `state_`
  Body state_;
  std::map<std::array<int, 3>, std::shared_ptr<BodyMaker<Revision>>> views_;
};

}  // namespace xr3::http
