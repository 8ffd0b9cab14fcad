/// Texts of the world on the screen, by what is drawn of them.
#include "render/presenter/screen_text.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/render/presenter/presenter_bench.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Of a picture's ink: first and last column, and rows.
struct Ink {
    int left = -1, right = -1, top = -1, bottom = -1;
};

Ink ink_of(const LinearImage& picture, int first_row = 0, int end_row = -1) {
    Ink ink;
    for (int y = first_row; y < (end_row < 0 ? picture.size_px.y : end_row); ++y) {
        for (int x = 0; x < picture.size_px.x; ++x) {
            if (picture.at(x, y).w < 0.5f)
                continue;
            ink.left = ink.left < 0 ? x : std::min(ink.left, x);
            ink.right = std::max(ink.right, x);
            ink.top = ink.top < 0 ? y : ink.top;
            ink.bottom = y;
        }
    }
    return ink;
}

TextStyle style_of(bool centred, int wrap_width_px = 600) {
    TextStyle style;
    style.line_height_px = 24;
    style.wrap_width_px = wrap_width_px;
    style.grey = 1.0f;
    style.centred = centred;
    return style;
}

struct Script {
    const char *name, *text;
};
constexpr Script scripts[] = {
    {"Latin", "Look at the sculpture as you like."},
    {"Norwegian", "Se på skulpturen slik du vil, i åtte sekunder – ærlig talt."},
    {"Greek", "Πόσων χρονών είναι αυτό το πρόσωπο;"},
    {"Russian", "Сколько лет этому человеку?"},
    {"Hebrew", "בן כמה האדם הזה?"},
    {"Arabic", "كم عمر هذا الشخص؟"},
    {"Chinese", "这个人多大年纪？请看雕塑。"},
    {"Japanese", "この人は何歳ですか。カタカナ。"},
    {"Korean", "이 사람은 몇 살입니까?"},
};

} // namespace

TEST_CASE("every script that packages.txt brings fonts for is drawn without boxes", "[unit]") {
    for (const Script& script : scripts) {
        CAPTURE(script.name);
        const TextMeasure measure = measure_text(script.text, style_of(true));
        CHECK(measure.unknown_glyphs == 0);
        CHECK(measure.size_px.x > 100);
    }
    // What no font has is counted: a code point of nobody's script.
    CHECK(measure_text("\U0003FF00", style_of(true)).unknown_glyphs > 0);
}

TEST_CASE("a paragraph from right to left begins at the right, one from left to right at the left",
          "[unit]") {
    const std::string latin = "one\na line that is very much longer than the first one";
    const std::string hebrew = "אחד\nשורה זו ארוכה הרבה יותר מן השורה הראשונה שלפניה";
    for (const std::string& text : {latin, hebrew}) {
        const bool is_latin = text == latin;
        const LinearImage picture = draw_text(text, style_of(false));
        const int half = picture.size_px.y / 2;
        const Ink first = ink_of(picture, 0, half), second = ink_of(picture, half);
        CAPTURE(is_latin, first.left, first.right, second.left, second.right);
        if (is_latin) {
            CHECK(std::abs(first.left - second.left) < 6);
            CHECK(first.right < second.right - 100);
        } else {
            CHECK(std::abs(first.right - second.right) < 6);
            CHECK(first.left > second.left + 100);
        }
    }
    // Centred, both stand in the middle.
    for (const std::string& text : {latin, hebrew}) {
        const LinearImage picture = draw_text(text, style_of(true));
        const Ink first = ink_of(picture, 0, picture.size_px.y / 2);
        CHECK(std::abs(first.left + first.right - picture.size_px.x) < 8);
    }
}

TEST_CASE("numbers in a Hebrew line keep their own direction, after the words before them", "[unit]") {
    // The wide M stands for what is written last: at the left end of the line.
    const LinearImage picture = draw_text("אבג 123 ||||||||||", style_of(false));
    const LinearImage mirrored = draw_text("abc 123 ||||||||||", style_of(false));
    const auto bars_at_left = [](const LinearImage& image) {
        // Bars are the only ink that fills the lowest and the highest rows.
        int left = 0, right = 0;
        const Ink all = ink_of(image);
        for (int x = all.left; x <= all.right; ++x)
            if (image.at(x, all.bottom).w > 0.5f)
                (x < (all.left + all.right) / 2 ? left : right) += 1;
        return left > right;
    };
    CHECK(bars_at_left(picture));
    CHECK_FALSE(bars_at_left(mirrored));
}

TEST_CASE("combining marks take no room of their own", "[unit]") {
    const auto width = [](const std::string& text) {
        return measure_text(text, style_of(true)).widest_line_px;
    };
    CHECK(width("nnnnee\u0301eenn") == width("nnnneeeenn"));
    CHECK(width("שלום") == width("שָׁלוֹם"));
    CHECK(width("aaaa") > width("aaa"));
    // They are drawn nevertheless.
    const Ink plain = ink_of(draw_text("e", style_of(true))),
              marked = ink_of(draw_text("e\u0301", style_of(true)));
    CHECK(marked.bottom - marked.top > plain.bottom - plain.top + 2);
}

TEST_CASE(
    "lines are wrapped within the safe width, whatever the script, and break within words that are longer",
    "[unit]") {
    ScreenGeometry geometry;
    geometry.screen_px = {800, 600};
    geometry.screen_mm = {400.0, 300.0};
    geometry.viewing_distance_mm = 570.0;
    for (const Script& script : scripts) {
        std::string text;
        for (int i = 0; i < 12; ++i)
            text += std::string(script.text) + " ";
        CAPTURE(script.name);
        const ScreenTextFit fit = fit_screen_text(text, false, geometry, 0.6);
        CHECK(fit.measure.lines > 1);
        CHECK(fit.measure.widest_line_px <= 640);
        CHECK_FALSE(fit.is_shrunk);
    }
    CHECK(fit_screen_text(std::string(200, 'W'), false, geometry, 0.6).measure.widest_line_px <= 640);
}

TEST_CASE("a text that is too high for the screen is set smaller until all of it is there", "[unit]") {
    ScreenGeometry geometry;
    geometry.screen_px = {800, 600};
    geometry.screen_mm = {400.0, 300.0};
    geometry.viewing_distance_mm = 570.0;
    std::string text;
    for (int line = 0; line < 40; ++line)
        text += "One of forty lines.\n";
    const ScreenTextFit fit = fit_screen_text(text, false, geometry, 0.6);
    CHECK(fit.is_shrunk);
    CHECK(fit.measure.size_px.y <= 540);
    CHECK(fit.line_height_px >= 8);
    CHECK(fit.fits);
    CHECK_FALSE(fit_screen_text(std::string(5000, '\n'), false, geometry, 0.6).fits);
    CHECK_THROWS_AS(fit_screen_text("\xff\xfe", false, geometry, 0.6), InputError);
}

TEST_CASE("the presenter shows consents and forms longer than its screen within it", "[gl]") {
    Bench bench;
    PagePresenter presenter(*bench.context, bench.display, bench.pages, bench.geometry, bench.settings,
                            bench.screens);
    for (const Screen::Kind kind : {Screen::Kind::text, Screen::Kind::form}) {
        presenter.show({kind, "a\nb\nc\nd\ne"});
        const auto canvas = presenter.read_canvas();
        int inked = 0;
        for (int y = 0; y < screen_px.y; ++y)
            for (int x = 0; x < screen_px.x; ++x)
                inked += red_at(canvas, {x, y}) > 40;
        CHECK(inked > 10);
    }
}

TEST_CASE("a form begins at the same place whatever stands in it, at the right from right to left",
          "[unit]") {
    ScreenGeometry geometry;
    geometry.screen_px = {1920, 1080};
    geometry.screen_mm = {531.0, 299.0};
    geometry.viewing_distance_mm = 600.0;
    const ScreenSettings screens;
    const auto drawn = [&](const char* text) { return draw_screen_text(text, true, geometry, screens, 0.0); };
    const LinearImage brief = drawn("Name:"), full = drawn("Name:  somebody with a very long name");
    CHECK(brief.size_px.x == full.size_px.x);
    CHECK(ink_of(brief).left == ink_of(full).left);
    const LinearImage brief_hebrew = drawn("שם:"), full_hebrew = drawn("שם: שם ארוך מאוד של מישהו");
    CHECK(brief_hebrew.size_px.x == full_hebrew.size_px.x);
    CHECK(ink_of(brief_hebrew).right == Approx(ink_of(full_hebrew).right).margin(2));
    CHECK(ink_of(brief_hebrew).left > full_hebrew.size_px.x / 2);
}
