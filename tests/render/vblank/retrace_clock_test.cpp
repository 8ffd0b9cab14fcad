/// Vertical blanks that a call on a thread of its own waits for.
#include "render/vblank/retrace_clock.h"

#include <atomic>
#include <semaphore>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
#include "experiment/base/error.h"
#include "render/vblank/vblank_sources.h"
#include "render/window/window_context.h"
#include "tests/support/virtual_screen.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

namespace {

/// A wait that returns when the test lets it.
class SteppedRetraces final : public RetraceWait {
  public:
    explicit SteppedRetraces(std::uint32_t first) : count_(first) {}
    void begin() override {}
    std::optional<std::uint32_t> next() noexcept override {
        steps_.acquire();
        return ends_ ? std::nullopt : std::optional(count_++);
    }
    void step() { steps_.release(); }
    void end() {
        ends_ = true;
        steps_.release();
    }

  private:
    std::counting_semaphore<> steps_{0};
    std::atomic<bool> ends_ = false;
    std::uint32_t count_;
};

struct NoRetraces final : RetraceWait {
    void begin() override { throw GraphicsError("the driver does not count"); }
    std::optional<std::uint32_t> next() noexcept override { return {}; }
};

} // namespace

TEST_CASE("each return of the wait is a vertical blank, stamped then", "[unit]") {
    const SteadyClock clock;
    // Its last number but one of 32 bits: the count goes on through it.
    const auto wait = std::make_shared<SteppedRetraces>(0xfffffffeU);
    wait->step();
    const auto source = watch_retraces(VblankSource::glx_video_sync, wait, clock);
    CHECK(source->source() == VblankSource::glx_video_sync);
    const auto first = source->last();
    REQUIRE(first);
    CHECK(first->at <= clock.now());
    CHECK(source->last() == first);
    VblankStamp before = *first;
    for (int i = 0; i < 4; ++i) {
        const SessionTime asked = clock.now();
        wait->step();
        const auto next = source->await(before.count + 1);
        REQUIRE(next);
        CHECK(next->count == before.count + 1);
        CHECK(next->at >= asked);
        CHECK(next->at <= clock.now());
        before = *next;
    }
    wait->end();
}

TEST_CASE("a wait that ends, or does not return any more, is a source that falls silent", "[unit]") {
    const SteadyClock clock;
    const auto wait = std::make_shared<SteppedRetraces>(10);
    wait->step();
    const auto source = watch_retraces(VblankSource::glx_video_sync, wait, clock);
    REQUIRE(source->last());
    SECTION("it ends") {
        wait->end();
        CHECK_FALSE(source->await(11));
        CHECK_FALSE(source->last());
    }
    SECTION("it keeps its thread for ever, which is left to itself") { CHECK_FALSE(source->await(11)); }
}

TEST_CASE("why a wait cannot be begun is the reason why the source is not there", "[unit]") {
    const SteadyClock clock;
    CHECK_THROWS_WITH(watch_retraces(VblankSource::glx_video_sync, std::make_shared<NoRetraces>(), clock),
                      Contains("the driver does not count"));
}

TEST_CASE("a server whose driver of OpenGL counts no refreshes is refused, not waited for", "[gl]") {
    const auto screen = VirtualScreen::start(320, 240, 24);
    SteadyClock clock;
    WindowContext window({{160, 120}, "video sync"});
    const VblankChoice choice = choose_vblank_clock(
        {{VblankSource::glx_video_sync, [&] { return open_glx_video_sync(window.native(), clock); }}}, clock);
    CHECK_FALSE(choice.clock);
    REQUIRE(choice.refused.size() == 1);
    UNSCOPED_INFO(choice.refused[0]);
    CHECK_THAT(choice.refused[0], Contains("GLX_SGI_video_sync: "));
}
