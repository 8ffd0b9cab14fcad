/// Messages to the display: in their rows, for their refresh, and no longer.
#include <catch2/catch.hpp>

#include "render/gl/headless_context.h"
#include "tests/render/signal/signal_bench.h"
#include "tests/support/gl_contexts.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("a message stands in its row for the flip it belongs to, and is gone at the next", "[gl]") {
    for (const ContextKind kind : test::headless_kinds) {
        const auto context = make_headless_context(kind);
        for (const OutputModeRow& row : output_modes) {
            if (row.top_rows != TopRows::t_lock)
                continue;
            SignalBench bench(*context, row.mode, {{32, 32}, {100, 100}});
            PagePresenter& presenter = *bench.presenter;
            presenter.flip({1});
            CHECK(bench.messages().packets.empty());
            presenter.send_with_next_flip(t_lock::clock_reset_row, t_lock::clock_reset());
            presenter.send_with_next_flip(t_lock::outputs_row, t_lock::pulse(5, 1.0, 2.0));
            presenter.flip({1});
            const ReceivedMessages sent = bench.messages();
            CHECK(sent.faults.empty());
            REQUIRE(sent.packets.size() == 2);
            CHECK(sent.packets[0].row == 1);
            CHECK(sent.packets[0].command == 12);
            CHECK(sent.packets[1].row == 2);
            const auto pulses = pulses_of(sent.packets[1]);
            REQUIRE(pulses.size() == 2);
            CHECK(pulses[1].line == 2);
            CHECK(pulses[1].begin_ms == Approx(1.0));
            CHECK(pulses[1].end_ms == Approx(3.0));
            // The picture is untouched by it, and the table of Bits++ is there each time.
            CHECK(bench.check(1, presenter.read_canvas()).different == 0);
            CHECK(sent.tables.size() == (row.shows == ShownLight::greys_by_table ? 1 : 0));
            presenter.flip({1});
            const ReceivedMessages next = bench.messages();
            CHECK(next.packets.empty());
            CHECK(next.tables.size() == sent.tables.size());
            CHECK(bench.check(1, presenter.read_canvas()).different == 0);
        }
    }
}

TEST_CASE("the onset trigger goes with the first refresh of each presentation, and only with it", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    SignalBench bench(*context, OutputMode::color_plus_plus, {{32, 32}, {100, 100}}, {640, 300},
                      Dithering::none, 1.0, 0b10000010);
    for (int presentation = 0; presentation < 2; ++presentation) {
        bench.presenter->show({});
        CHECK(bench.messages().packets.empty());
        bench.presenter->flip({0});
        const ReceivedMessages onset = bench.messages();
        REQUIRE(onset.packets.size() == 1);
        const auto pulses = pulses_of(onset.packets[0]);
        REQUIRE(pulses.size() == 2);
        CHECK(pulses[0].line == 1);
        CHECK(pulses[1].line == 7);
        CHECK(pulses[0].end_ms == Approx(5.0));
        for (const int frame : {0, 1, 2}) {
            bench.presenter->flip({frame});
            CHECK(bench.messages().packets.empty());
        }
    }
}

TEST_CASE("the top left pixel raises a VPixx device's outputs for the first refresh of a presentation",
          "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    for (const OutputModeRow& row : output_modes) {
        if (row.top_rows != TopRows::psync)
            continue;
        SignalBench bench(*context, row.mode, {{32, 32}, {100, 100}}, {640, 300}, Dithering::none, 1.0,
                          0x8142a5);
        for (int presentation = 0; presentation < 2; ++presentation) {
            bench.presenter->show({});
            CHECK(bench.messages().pixel_mode_outputs == 0);
            bench.presenter->flip({1});
            CHECK(bench.messages().pixel_mode_outputs == 0x8142a5);
            const std::vector<std::byte> bytes = bench.presenter->read_canvas();
            CHECK(bytes[0] == std::byte{0xa5});
            CHECK(bytes[1] == std::byte{0x42});
            CHECK(bytes[2] == std::byte{0x81});
            for (const int frame : {1, 2}) {
                bench.presenter->flip({frame});
                CHECK(bench.messages().pixel_mode_outputs == 0);
            }
        }
    }
}

TEST_CASE("PSYNC counts the refreshes on a black row", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    for (const OutputModeRow& row : output_modes) {
        if (row.top_rows != TopRows::psync)
            continue;
        SignalBench bench(*context, row.mode, {{32, 32}, {100, 100}});
        for (int refresh = 0; refresh < 300; ++refresh) {
            bench.presenter->flip({refresh % 3});
            if (refresh % 37 == 0)
                CHECK(bench.messages().psync_count == (refresh + 1) % 256);
        }
        const std::vector<std::byte> bytes = bench.presenter->read_canvas();
        for (std::size_t x = 0; x < 640; ++x) {
            if (x < 10 || x >= 18) {
                for (std::size_t channel = 0; channel < 3; ++channel)
                    CHECK(bytes[4 * x + channel] == std::byte{0});
            }
        }
    }
}
