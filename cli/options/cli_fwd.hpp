// Declares the command line of CLI11, whose headers take seconds to compile: only files that define
// options include them.
#pragma once

namespace CLI {
class App;
}
