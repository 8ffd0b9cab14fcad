/// Counts the allocations of each thread of this test program.
#include <cstdlib>
#include <new>

#include <catch2/catch.hpp>

#include "experiment/record/session_record.h"
#include "experiment/record/session_schema.h"
#include "experiment/session_fixture.h"

namespace {

thread_local long allocations = 0;

void* allocate(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size ? size : 1))
        return memory;
    throw std::bad_alloc();
}

} // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
// Sanitizers bring these two of their own, which would not go with the operator delete below.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return std::malloc(size ? size : 1); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return std::malloc(size ? size : 1);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

using namespace overt;
using namespace overt::testing;

TEST_CASE("noting flips, samples and clock pairs allocates nothing, with a full ring too", "[unit]") {
    const TemporaryFolder root;
    const SessionHeader header = example_header();
    const auto session = make_session(root.path(), header);
    SessionStore::Options options = patient();
    options.wait_when_full = GENERATE(true, false);
    options.ring_capacity = 64;
    SessionStore store(session / session_file_name, options);
    const long before_event = allocations;
    store.trial_started(header.schedule.trials[0], at_ms(0));
    CHECK(allocations > before_event); // the counter counts

    const long before = allocations;
    for (int i = 0; i < 20'000; ++i) {
        GazeSample sample;
        sample.gaze = ScreenPoint{0.5 * i, 1.0};
        store.sample(0, sample);
        if (i % 16 == 0) {
            store.flip({});
            store.clock_pair({});
        }
    }
    CHECK(allocations == before);
    store.trial_finished(header.schedule.trials[0], outcome_at(0));
}
