// What the kernel still does for the process that reads strangers' files.
#pragma once
#include <vector>

struct sock_filter;

namespace cullet {

/// A process that it is applied to reads files and ends, and does nothing else: no network, no other process or program
/// and no signal to one, no file opened to write, none made, removed, renamed or dated. Refused calls fail and do not
/// kill: libc and assimp know what to do without most of them.
class SystemCallFilter {
 public:
    /// Takes memory, which libseccomp does not expect to be refused: to be made before memory is limited.
    SystemCallFilter();
    ~SystemCallFilter();
    SystemCallFilter(const SystemCallFilter&) = delete;
    SystemCallFilter& operator=(const SystemCallFilter&) = delete;

    /// From now on and for good: it cannot be taken back. False where it could not be done. Takes no memory.
    bool apply() const;

 private:
    std::vector<sock_filter> program_;
};

/// Whether this kernel was built with such filters.
bool has_filters_of_system_calls();

}  // namespace cullet
