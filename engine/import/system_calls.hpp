// What the kernel still does for the process that reads strangers' files.
#pragma once

namespace cullet {

/// From now on this process reads files and ends, and nothing else: no network, no other process or program and no
/// signal to one, no file opened to write, none made, removed, renamed or dated. Refused calls fail and do not kill:
/// libc and assimp know what to do without most of them. For good: it cannot be taken back. False where it
/// could not be done.
bool forbid_system_calls();

/// Whether this kernel was built with such filters.
bool has_filters_of_system_calls();

}  // namespace cullet
