#include "experiment/base/spsc_ring.h"

#include <thread>

#include <catch2/catch.hpp>

using namespace overt;

TEST_CASE("what one thread pushes into the ring another pops in order, whole and once", "[unit]") {
    struct Item {
        std::uint64_t number, square;
    };
    constexpr std::uint64_t count = 200'000;
    SpscRing<Item> ring(64);
    std::thread producer([&] {
        for (std::uint64_t i = 0; i < count; ++i)
            while (!ring.try_push({i, i * i}))
                ring.wait_for_room();
    });
    std::uint64_t expected = 0, torn = 0, out_of_order = 0;
    Item item{};
    while (expected < count) {
        if (!ring.try_pop(item)) {
            std::this_thread::yield();
            continue;
        }
        ring.announce_room();
        torn += item.square != item.number * item.number;
        out_of_order += item.number != expected++;
    }
    producer.join();
    CHECK(torn == 0);
    CHECK(out_of_order == 0);
    CHECK_FALSE(ring.try_pop(item));
}

TEST_CASE("a ring takes as many items as it holds and then refuses", "[unit]") {
    SpscRing<int> ring(5);
    REQUIRE(ring.capacity() == 8);
    for (int i = 0; i < 8; ++i)
        CHECK(ring.try_push(i));
    CHECK_FALSE(ring.try_push(8));
    int item = -1;
    CHECK(ring.try_pop(item));
    CHECK(item == 0);
    CHECK(ring.try_push(8));
    CHECK(ring.size() == 8);
}
