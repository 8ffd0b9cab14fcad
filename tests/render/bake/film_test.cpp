#include "render/bake/film.h"

#include <numeric>

#include <catch2/catch.hpp>

using namespace overt;

TEST_CASE("where all pixels are equally noisy each states the same error, in corners and on borders, too",
          "[unit]") {
    const glm::ivec2 size(9, 7);
    const std::vector<std::uint8_t> covered(static_cast<std::size_t>(size.x * size.y), 1);
    Film film(size, 1, covered);
    REQUIRE(film.count() == covered.size());
    std::vector<std::uint32_t> all(film.count());
    std::iota(all.begin(), all.end(), 0u);
    const auto gather = [&](float light) {
        for (const std::uint32_t index : all) {
            add(film.pixel(index).light, Bins::filled(4.0f * light));
            film.pixel(index).samples += 4;
            film.pixel(index).met += 4;
        }
    };
    gather(0.5f);
    film.begin_round(all);
    gather(0.6f);
    // A target of 0 is never reached, one of 100 always.
    CHECK(film.noisier_than(100.0, 1.0, 8).empty());
    CHECK(film.noisier_than(1e-6, 1.0, 8).size() == film.count());
    const float error = film.pixel(film.count() / 2).error_de;
    CHECK(error > 0.0f);
    for (const std::uint32_t index : all)
        REQUIRE(film.pixel(index).error_de == Approx(error).epsilon(1e-5));
}
