// Restricts the system calls of a program in the sandbox.
#pragma once

namespace xr3 {

/// Takes away from this process, and from its descendants, the calls that read or use the kernel's
/// keys, which belong to a user and not to a namespace; sockets of families that no network
/// namespace confines, such as AF_VSOCK; io_uring. Programs of another processor type, as of 32
/// bits, get no call at all. The session keyring becomes a new one. Only async-signal-safe calls.
/// Returns whether it succeeded.
bool restrict_system_calls();

}  // namespace xr3
