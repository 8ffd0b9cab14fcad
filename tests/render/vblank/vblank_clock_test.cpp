#include <array>
#include <chrono>
#include <cstdlib>
#include <thread>

#include <catch2/catch.hpp>
#include <xcb/xcb.h>

#include "devices/host/clocks.h"
#include "experiment/base/error.h"
#include "render/vblank/vblank_sources.h"
#include "render/vblank/window_flips.h"
#include "render/window/window_context.h"
#include "tests/support/fake_vblanks.h"
#include "tests/support/virtual_screen.h"

using namespace overt;
using namespace overt::test;

namespace {

SessionTime at_ms(double ms) { return SessionTime(from_seconds(1e-3 * ms)); }

FlipReport flip_at(double ms, VblankSource source = VblankSource::drm_vblank) {
    FlipReport report;
    report.vertical_blank = at_ms(ms);
    report.source = source;
    return report;
}

/// Waits until the server, which serves each connection in its own time, has taken the window away.
void await_end_of(const NativeWindow& window) {
    xcb_connection_t* const link = xcb_connect(window.x11_server.c_str(), nullptr);
    for (;;) {
        xcb_get_window_attributes_reply_t* const known = xcb_get_window_attributes_reply(
            link, xcb_get_window_attributes(link, window.x11_window), nullptr);
        if (!known)
            break;
        std::free(known);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    xcb_disconnect(link);
}

} // namespace

TEST_CASE("a source fits whose count and clock go on like the session's refreshes", "[unit]") {
    VirtualClock clock;
    clock.wait_until(at_ms(5003));
    FakeVblanks source(clock);
    CHECK(why_unfit(source, clock).empty());
    CHECK(stamps_stand_still(source, clock));

    SECTION("not with stamps of another clock, ahead or behind") {
        source.clock_error = std::chrono::seconds(1'700'000'000);
        CHECK(why_unfit(source, clock).find("clock") != std::string::npos);
        source.clock_error = -std::chrono::seconds(1);
        CHECK(why_unfit(source, clock).find("clock") != std::string::npos);
    }
    SECTION("not with a count that stands still, or is not one of refreshes") {
        source.stands_still = true;
        CHECK(why_unfit(source, clock).find("still") != std::string::npos);
        source.stands_still = false;
        source.hz = 5000.0;
        CHECK(why_unfit(source, clock).find("5000") != std::string::npos);
    }
    SECTION("not when it falls silent while it is tried") {
        source.dies_at = clock.now() + std::chrono::milliseconds(25);
        CHECK_FALSE(why_unfit(source, clock).empty());
    }
    SECTION("and is no real vertical blank where each asking gives another time") {
        source.stamps_are_of_asking = true;
        CHECK(why_unfit(source, clock).empty());
        CHECK_FALSE(stamps_stand_still(source, clock));
    }
}

TEST_CASE("the first source that fits is taken, and what was refused says why", "[unit]") {
    VirtualClock clock;
    const auto absent = []() -> std::unique_ptr<VblankClock> {
        throw GraphicsError("the server does not offer it");
    };
    const auto foreign = [&]() -> std::unique_ptr<VblankClock> {
        auto source = std::make_unique<FakeVblanks>(clock);
        source->clock_error = std::chrono::hours(24);
        return source;
    };
    const auto good = [&]() -> std::unique_ptr<VblankClock> { return std::make_unique<FakeVblanks>(clock); };
    const VblankChoice choice = choose_vblank_clock({{VblankSource::glx_sync_control, absent},
                                                     {VblankSource::present_count, foreign},
                                                     {VblankSource::drm_vblank, good}},
                                                    clock);
    REQUIRE(choice.clock);
    CHECK(choice.clock->source() == VblankSource::drm_vblank);
    CHECK(choice.is_real);
    REQUIRE(choice.refused.size() == 2);
    CHECK(choice.refused[0] == "GLX_OML_sync_control: the server does not offer it");
    CHECK(choice.refused[1].find("clock is not the session's") != std::string::npos);

    const auto timer = [&]() -> std::unique_ptr<VblankClock> {
        auto source = std::make_unique<FakeVblanks>(clock);
        source->stamps_are_of_asking = true;
        source->hz = 60.0;
        return source;
    };
    // A server's timer stands before a real one only where there is none.
    const VblankChoice better =
        choose_vblank_clock({{VblankSource::present_count, timer}, {VblankSource::drm_vblank, good}}, clock);
    REQUIRE(better.clock);
    CHECK(better.is_real);
    CHECK(dynamic_cast<FakeVblanks&>(*better.clock).hz == 100.0);
    REQUIRE(better.refused.size() == 1);
    CHECK(better.refused[0].ends_with("not a real one"));
    const VblankChoice worse = choose_vblank_clock(
        {{VblankSource::present_count, timer}, {VblankSource::drm_vblank, absent}}, clock);
    REQUIRE(worse.clock);
    CHECK_FALSE(worse.is_real);
    CHECK(worse.refused.size() == 1);

    const VblankChoice none = choose_vblank_clock({{VblankSource::glx_sync_control, absent}}, clock);
    CHECK_FALSE(none.clock);
}

TEST_CASE("flips are numbered by the source's count, and what went by is missed exactly", "[unit]") {
    FlipCount count(100.0);
    FlipReport first = flip_at(1000.0);
    count.number(first, 70);
    FlipReport next = flip_at(1010.0);
    count.number(next, 71);
    CHECK(next.refresh.value == first.refresh.value + 1);
    // The stamp lies nearer to two refreshes on, the count knows better.
    FlipReport late = flip_at(1045.1);
    count.number(late, 74);
    CHECK(late.refresh.value == next.refresh.value + 3);
}

TEST_CASE("a count that time contradicts is not believed, and is followed from where it jumped to",
          "[unit]") {
    for (const std::int64_t jump : {std::int64_t{-69}, std::int64_t{500'000}}) {
        FlipCount count(100.0);
        FlipReport first = flip_at(1000.0), jumped = flip_at(1010.0), after = flip_at(1030.0);
        count.number(first, 70);
        count.number(jumped, 71 + jump);
        CHECK(jumped.refresh.value == first.refresh.value + 1);
        count.number(after, 73 + jump);
        CHECK(after.refresh.value == jumped.refresh.value + 2);
    }
}

TEST_CASE("without the source the numbers go on by time", "[unit]") {
    FlipCount count(100.0);
    std::int64_t last = 0;
    for (int i = 0; i < 200; ++i) {
        // The swap's return is late by some tenths of a refresh; one flip in forty misses a refresh.
        const bool died = i >= 100;
        const int refresh = i + i / 40;
        FlipReport report = flip_at(10.0 * refresh + (died ? 1.0 + 0.5 * (i % 3) : 0.0),
                                    died ? VblankSource::swap_return : VblankSource::drm_vblank);
        count.number(report, died ? std::optional<std::int64_t>() : refresh + 12345);
        if (i > 0)
            CHECK(report.refresh.value - last == (i % 40 == 0 ? 2 : 1));
        last = report.refresh.value;
    }
}

TEST_CASE("times since boot become the session's", "[unit]") {
    const SteadyClock clock;
    const MonotonicTime time(clock);
    const auto before = clock.now();
    const auto boot = std::chrono::duration_cast<std::chrono::nanoseconds>(
        std::chrono::steady_clock::now().time_since_epoch());
    const auto after = clock.now();
    CHECK(time.of_nanoseconds(boot.count()) >= before - std::chrono::microseconds(200));
    CHECK(time.of_nanoseconds(boot.count()) <= after + std::chrono::microseconds(200));
    CHECK(std::chrono::abs(time.of_microseconds(boot.count() / 1000) - time.of_nanoseconds(boot.count())) <=
          std::chrono::microseconds(1));
}

TEST_CASE("on a server of X the Present extension counts the refreshes of a window", "[gl]") {
    const auto screen = VirtualScreen::start(320, 240, 24);
    SteadyClock clock;
    WindowContext window({{160, 120}, "vertical blanks"});
    const auto source = open_x_present(window.native(), clock);
    CHECK(source->source() == VblankSource::present_count);
    CHECK(why_unfit(*source, clock).empty());
    // Software has no vertical blank: the server tells the time of the asking.
    CHECK_FALSE(stamps_stand_still(*source, clock));

    const auto first = source->last();
    REQUIRE(first);
    const auto later = source->await(first->count + 5);
    REQUIRE(later);
    CHECK(later->count >= first->count + 5);
    CHECK(later->at > first->at);

    SECTION("each swap has a refresh of its own there, which nothing else could tell in software") {
        WindowFlips flips(window, clock, 60.0, open_x_present(window.native(), clock),
                          std::chrono::milliseconds(1));
        std::int64_t last = 0;
        for (int i = 0; i < 20; ++i) {
            flips.begin();
            window.gl().Clear(GL_COLOR_BUFFER_BIT);
            const FlipReport report = flips.swap(clock.now());
            CHECK(report.source == VblankSource::present_count);
            CHECK(report.refresh.value > last);
            last = report.refresh.value;
        }
    }
    SECTION("what a server does not have is refused with its reason") {
        const VblankChoice choice = choose_vblank_clock(vblank_candidates(window, clock), clock);
        REQUIRE(choice.clock);
        CHECK_FALSE(choice.is_real);
        CHECK_FALSE(choice.refused.empty());
    }
}

TEST_CASE("without a source the next picture's first pixel is waited for, and a time is good for a refresh",
          "[gl]") {
    const auto screen = VirtualScreen::start(320, 240, 24);
    SteadyClock clock;
    WindowContext window({{160, 120}, "no source"});
    const GladGLContext& gl = window.gl();
    constexpr double hz = 50.0;
    WindowFlips flips(window, clock, hz, nullptr, {});
    for (int i = 0; i < 3; ++i) {
        flips.begin();
        gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        gl.ClearColor(1.0f, 1.0f, 1.0f, 1.0f);
        gl.Clear(GL_COLOR_BUFFER_BIT);
        const FlipReport report = flips.swap(clock.now());
        CHECK(report.source == VblankSource::swap_return);
        CHECK(report.uncertainty >= from_seconds(1.0 / hz));
        std::array<std::uint8_t, 4> pixel{1, 1, 1, 1};
        gl.BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
        gl.ReadBuffer(GL_BACK);
        gl.ReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
        CHECK(pixel[0] + pixel[1] + pixel[2] == 0);
    }
    // It is cut to that pixel for nothing else.
    CHECK_FALSE(gl.IsEnabled(GL_SCISSOR_TEST));
}

TEST_CASE("a source of Present whose window goes falls silent, and flips go on by their swaps", "[gl]") {
    const auto screen = VirtualScreen::start(320, 240, 24);
    SteadyClock clock;
    WindowContext window({{160, 120}, "stays"});
    std::unique_ptr<VblankClock> source;
    NativeWindow gone;
    {
        WindowContext other({{160, 120}, "goes"});
        gone = other.native();
        source = open_x_present(gone, clock);
        REQUIRE(source->last());
    }
    window.make_current();
    await_end_of(gone);
    CHECK_FALSE(source->last());
    WindowFlips flips(window, clock, 60.0, std::move(source), std::chrono::milliseconds(1));
    std::int64_t last = 0;
    for (int i = 0; i < 3; ++i) {
        flips.begin();
        const FlipReport report = flips.swap(clock.now());
        CHECK(report.source == VblankSource::swap_return);
        CHECK(flips.source() == VblankSource::swap_return);
        CHECK(report.refresh.value > last);
        last = report.refresh.value;
    }
}
