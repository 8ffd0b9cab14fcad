/// That the texts of a screen stand apart, and on it.
#pragma once

#include <catch2/catch.hpp>

#include "render/presenter/screen_text.h"

namespace overt::test {

inline bool do_meet(const InkBox& a, const InkBox& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

inline void check_texts(const PlacedPicture& drawn, glm::ivec2 drawn_px) {
    for (std::size_t i = 0; i < drawn.texts.size(); ++i) {
        const InkBox& text = drawn.texts[i];
        CAPTURE(i, text.x, text.y, text.width, text.height);
        CHECK((text.x >= 0.0 && text.y >= 0.0));
        CHECK((text.x + text.width <= drawn_px.x && text.y + text.height <= drawn_px.y));
        for (std::size_t j = i + 1; j < drawn.texts.size(); ++j) {
            const InkBox& other = drawn.texts[j];
            CAPTURE(j, other.x, other.y, other.width, other.height);
            REQUIRE_FALSE(do_meet(text, other));
        }
    }
}

} // namespace overt::test
