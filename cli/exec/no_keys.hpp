// A filter of system calls for programs in the sandbox.
#pragma once

namespace xr3 {

/// Takes this process, and what it starts, the calls that read or use the kernel's keys, which
/// belong to a user and not to a namespace; programs of another processor type, as of 32 bits, get
/// no call at all. The session keyring becomes a new one. Only async-signal-safe calls. Returns
/// whether it succeeded.
bool give_up_keys();

}  // namespace xr3
