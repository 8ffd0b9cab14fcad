/// The table of output modes and what packs and reads them say the same.
#include <catch2/catch.hpp>

#include "render/gl/headless_context.h"
#include "render/signal/mode_coding.h"
#include "render/signal/signal_decoder.h"
#include "tests/render/signal/signal_bench.h"
#include "tests/support/gl_contexts.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("what a decoder knows of its mode is what the table says", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    for (const OutputModeRow& row : output_modes) {
        CAPTURE(row.name);
        SignalBench bench(*context, row.mode, {{32, 32}, {100, 100}});
        bench.presenter->flip({1});
        const std::vector<std::byte> bytes = bench.presenter->read_canvas();
        const ReceivedLight light = receive_light({{640, 300}, bytes}, row.mode);
        CHECK(light.size.x == (row.joins_pixels_in_pairs ? 320 : 640));
        CHECK(light.size.y == 300);
        // Of an index the table in the picture makes light of 16 bits, of each channel by itself.
        const bool has_table = row.shows == ShownLight::greys_by_table;
        CHECK(light.highest == (has_table ? 65535 : row.levels));
        CHECK(light.is_grey == (row.shows == ShownLight::greys));
        CHECK(bench.messages().tables.size() == (has_table ? 1 : 0));
        CHECK(bench.messages().psync_count.has_value() == (row.top_rows == TopRows::psync));
    }
}
