// What every call of the game's runs in: our floating-point mode, and the host's assert handler.
#pragma once
#include "cullet/host.hpp"
#include "cullet/result.hpp"
#include "engine/assert.hpp"
#include "engine/fp_mode.hpp"

namespace cullet {

/// Halves of pairs are refused.
Result<void> check_host(const Host& host);

class HostScope {
 public:
    /// `host` outlives this.
    explicit HostScope(const Host& host) : handler_(handler_of(host)) {}

 private:
    static AssertHandler handler_of(const Host& host) {
        if (!host.assertion_failed) return {};
        return {[](const char* sentence, void* user) {
                    const auto* h = static_cast<const Host*>(user);
                    h->assertion_failed(h->user, sentence);
                },
                const_cast<Host*>(&host)};
    }
    FpMode mode_;
    AssertScope handler_;
};

}  // namespace cullet
