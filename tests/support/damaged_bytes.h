/// Damage as lines and files suffer it: what reads bytes from outside must stand it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "experiment/base/random.h"

namespace overt::test {

/// Calls `take` with `count` damaged copies of `whole`: bytes changed, cut out, repeated, the end lost. Each
/// copy has a memory of exactly its size, so that a sanitizer sees a step beyond it.
template <class Take> void each_damage(std::string_view whole, int count, Take&& take) {
    for (int copy = 0; copy < count; ++copy) {
        RandomStream random(static_cast<std::uint64_t>(copy), "damage");
        std::string bytes(whole);
        const auto place = [&] { return random.below(static_cast<std::uint32_t>(bytes.size())); };
        for (std::uint32_t wounds = 1 + random.below(4); wounds > 0 && !bytes.empty(); --wounds) {
            const std::size_t at = place();
            switch (random.below(4)) {
            case 0:
                bytes[at] = static_cast<char>(random.below(256));
                break;
            case 1:
                bytes.erase(at, 1 + random.below(8));
                break;
            case 2:
                bytes.insert(at, bytes.substr(place(), 1 + random.below(16)));
                break;
            default:
                bytes.resize(at);
            }
        }
        bytes.shrink_to_fit();
        take(std::string_view(bytes));
    }
}

} // namespace overt::test
