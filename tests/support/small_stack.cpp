#include "tests/support/small_stack.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cstring>

namespace cullet::test {
namespace {

constexpr size_t kGuard = 64 * 1024;  // more than any frame that a call could step over it with
constexpr int kPaint = 0xa5;

/// A thread on memory of ours, with unreadable memory below it.
class PaintedThread {
 public:
    PaintedThread(size_t bytes, const std::function<void()>& call) : bytes_(bytes), call_(call) {
        memory_ = static_cast<unsigned char*>(
            mmap(nullptr, kGuard + bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
        EXPECT_NE(memory_, MAP_FAILED);
        EXPECT_EQ(mprotect(memory_, kGuard, PROT_NONE), 0);
        std::memset(memory_ + kGuard, kPaint, bytes);
        pthread_attr_t attributes;
        pthread_attr_init(&attributes);
        EXPECT_EQ(pthread_attr_setstack(&attributes, memory_ + kGuard, bytes), 0);
        const auto run = [](void* self) -> void* {
            static_cast<PaintedThread*>(self)->call_();
            return nullptr;
        };
        is_started_ = pthread_create(&thread_, &attributes, run, this) == 0;
        EXPECT_TRUE(is_started_);
        pthread_attr_destroy(&attributes);
    }
    ~PaintedThread() {
        join();
        munmap(memory_, kGuard + bytes_);
    }
    PaintedThread(const PaintedThread&) = delete;
    PaintedThread& operator=(const PaintedThread&) = delete;

    size_t join() {
        if (is_started_) pthread_join(thread_, nullptr);
        is_started_ = false;
        const unsigned char* const first = memory_ + kGuard;
        return bytes_ -
               static_cast<size_t>(std::find_if(first, first + bytes_, [](int b) { return b != kPaint; }) - first);
    }

 private:
    size_t bytes_;
    const std::function<void()>& call_;
    unsigned char* memory_;
    pthread_t thread_;
    bool is_started_ = false;
};

}  // namespace

size_t run_on_stack(size_t bytes, const std::function<void()>& call) {
    PaintedThread thread(bytes, call);
    return thread.join();
}

HostJobs SmallStackJobs::jobs() {
    HostJobs jobs;
    jobs.user = this;
    jobs.worker_count = [](void*) { return 2u; };
    jobs.parallel_for = [](void* user, uint32_t count, void (*job)(void*, uint32_t), void* context) {
        auto& self = *static_cast<SmallStackJobs*>(user);
        std::atomic<uint32_t> next{0};
        const std::function<void()> work = [&] {
            for (uint32_t i = next++; i < count; i = next++) job(context, i);
        };
        PaintedThread first(self.bytes_, work), second(self.bytes_, work);
        self.most_used_ = std::max({self.most_used_, first.join(), second.join()});
    };
    return jobs;
}

}  // namespace cullet::test
