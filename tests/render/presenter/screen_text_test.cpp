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

Screen of_text(const std::string& text) { return {.kind = Screen::Kind::text, .text = text}; }

struct Script {
    const char *name, *text;
};
constexpr Script scripts[] = {
    {"Latin", "Look at the object as you like."},
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
        const int middle = picture.size_px.y / 2;
        const Ink first = ink_of(picture, 0, middle), second = ink_of(picture, middle);
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
        const ScreenTextFit fit = fit_screen(of_text(text), geometry, 0.6);
        CHECK(fit.measure.lines > 1);
        CHECK(fit.measure.widest_line_px <= 640);
        CHECK_FALSE(fit.is_shrunk);
    }
    CHECK(fit_screen(of_text(std::string(200, 'W')), geometry, 0.6).measure.widest_line_px <= 640);
}

TEST_CASE("a text that is too high for the screen is set smaller until all of it is there", "[unit]") {
    ScreenGeometry geometry;
    geometry.screen_px = {800, 600};
    geometry.screen_mm = {400.0, 300.0};
    geometry.viewing_distance_mm = 570.0;
    std::string text;
    for (int line = 0; line < 30; ++line)
        text += "One of thirty lines.\n";
    const ScreenTextFit fit = fit_screen(of_text(text), geometry, 0.6);
    CHECK(fit.is_shrunk);
    CHECK(fit.measure.size_px.y <= 450);
    CHECK(fit.line_height_px >= 8);
    CHECK(fit.fits);
    CHECK_FALSE(fit_screen(of_text(std::string(5000, '\n')), geometry, 0.6).fits);
    CHECK_THROWS_AS(fit_screen(of_text("\xff\xfe"), geometry, 0.6), InputError);
}

TEST_CASE("the presenter shows consents and forms longer than its screen within it", "[gl]") {
    Bench bench;
    PagePresenter presenter(*bench.context, bench.display, bench.pages, bench.geometry, bench.settings,
                            bench.screens);
    for (const Screen& screen :
         {of_text("a\nb\nc\nd\ne"), Screen{.kind = Screen::Kind::form,
                                    .text = "# t",
                                    .rows = {{.label = "a", .value = "b", .choices = {}, .is_here = true},
                                             {.label = "c", .value = "", .choices = {"d", "e"}}}}}) {
        presenter.show(screen);
        const auto canvas = presenter.read_canvas();
        int inked = 0;
        for (int y = 0; y < screen_px.y; ++y)
            for (int x = 0; x < screen_px.x; ++x)
                inked += red_at(canvas, {x, y}) > 40;
        CHECK(inked > 10);
    }
}

namespace {

ScreenGeometry desk() {
    ScreenGeometry geometry;
    geometry.screen_px = {1920, 1080};
    geometry.screen_mm = {531.0, 299.0};
    geometry.viewing_distance_mm = 600.0;
    return geometry;
}

/// The whole screen, with what is drawn where it is.
LinearImage on_screen(const Screen& screen) {
    const ScreenGeometry geometry = desk();
    const PlacedPicture drawn = draw_screen(screen, geometry, ScreenSettings(), 0.0);
    LinearImage whole(geometry.screen_px);
    for (int y = 0; y < drawn.picture.size_px.y; ++y)
        for (int x = 0; x < drawn.picture.size_px.x; ++x)
            whole.at(drawn.origin_px.x + x, drawn.origin_px.y + y) = drawn.picture.at(x, y);
    return whole;
}

/// Rows of a share of the screen's height.
Ink ink_between(const LinearImage& whole, double from, double to) {
    return ink_of(whole, static_cast<int>(from * whole.size_px.y), static_cast<int>(to * whole.size_px.y));
}

Screen form_of(const std::string& label, const std::string& typed, const std::string& chosen,
               const std::string& message = {}) {
    return {.kind = Screen::Kind::form,
            .text = "# Form\n" + message,
            .rows = {{.label = label,
                      .value = typed,
                      .choices = {},
                      .is_here = true,
                      .is_at_fault = !message.empty()},
                     {.label = label, .value = chosen, .choices = {"aa", "bb", "cc"}}},
            .page = 1,
            .pages = 2};
}

} // namespace

TEST_CASE("a form stays in its place whatever is typed, chosen and said of it", "[unit]") {
    // The panel's outline is fainter than its letters, and farthest out.
    const auto sides_of = [](const LinearImage& whole) {
        glm::ivec2 sides(whole.size_px.x, 0);
        for (int y = whole.size_px.y * 35 / 100; y < whole.size_px.y / 2; ++y)
            for (int x = 0; x < whole.size_px.x; ++x)
                if (whole.at(x, y).w > 0.3f)
                    sides = {std::min(sides.x, x), std::max(sides.y, x)};
        return sides;
    };
    const glm::ivec2 empty = sides_of(on_screen(form_of("Name", "", "")));
    CHECK(empty.x < 0.4 * desk().screen_px.x);
    for (const Screen& other : {form_of("Name", std::string(90, 'w'), ""), form_of("Name", "x", "cc"),
                                form_of("Name", "", "", "Name: please fill this in")})
        CHECK(sides_of(on_screen(other)) == empty);
}

TEST_CASE("from right to left, labels of a form stand at its right and what is typed at the left of them",
          "[unit]") {
    const auto label_of = [](const std::string& label) { return on_screen(form_of(label, "", "")); };
    const auto centre_of_ink = [](const LinearImage& whole) {
        double sum = 0.0, count = 0.0;
        for (int y = whole.size_px.y * 3 / 10; y < whole.size_px.y * 6 / 10; ++y)
            for (int x = 0; x < whole.size_px.x; ++x)
                if (whole.at(x, y).w > 0.9f) {
                    sum += x;
                    ++count;
                }
        return sum / count / whole.size_px.x;
    };
    CHECK(centre_of_ink(label_of("Nachname")) < 0.5);
    CHECK(centre_of_ink(label_of("اسم العائلة")) > 0.5);
}

TEST_CASE("keys, and how far it is, stand below the text, and a frame is for the operator alone", "[unit]") {
    Screen screen = of_text("What is it?");
    const LinearImage bare = on_screen(screen);
    CHECK(ink_between(bare, 0.82, 1.0).left == -1);
    screen.keys = {{"space bar", "go on"}};
    CHECK(ink_between(on_screen(screen), 0.82, 0.9).left > 0);
    CHECK(ink_between(on_screen(screen), 0.9, 1.0).left == -1);
    screen.page = 2;
    screen.pages = 3;
    CHECK(ink_between(on_screen(screen), 0.9, 1.0).left > 0);
    CHECK(ink_between(on_screen(screen), 0.0, 0.06).left == -1);
    screen.frame = "For the experimenter";
    const Ink framed = ink_of(on_screen(screen));
    CHECK(framed.left < 0.03 * 1920);
    CHECK(framed.bottom > 0.96 * 1080);
}

TEST_CASE("a title is larger than its text, and lines are no longer than some sixty letters", "[unit]") {
    const double height_deg = 0.5;
    const auto height = [&](const std::string& text) {
        return fit_screen(of_text(text), desk(), height_deg).measure.size_px.y;
    };
    CHECK(height("# Title") > 1.25 * height("Title"));
    std::string text;
    for (int word = 0; word < 200; ++word)
        text += "object ";
    const ScreenTextFit fit = fit_screen(of_text(text), desk(), height_deg);
    const ScreenTextFit sixty = fit_screen(of_text(text.substr(0, 69)), desk(), height_deg);
    CHECK(fit.measure.widest_line_px <= sixty.measure.widest_line_px * 70 / 69);
}

TEST_CASE("emphasis is drawn, and what only looks like it stands as it is", "[unit]") {
    const auto width = [](const std::string& text) {
        return fit_screen(of_text(text), desk(), 0.8).measure.widest_line_px;
    };
    CHECK(width("<b>material</b>") > width("material"));
    CHECK(width("<big>material</big>") > width("<small>material</small>"));
    CHECK(width("a < b & c > d <c>") == width("a &lt; b &amp; c &gt; d &lt;c>"));
    CHECK(width("&lt;b>x") > width("<b>x</b>"));
    for (const char* wrong : {"<b>x", "x</b>", "<b><i>x</b></i>"}) {
        CAPTURE(wrong);
        CHECK_THROWS_AS(width(wrong), InputError);
    }
}

TEST_CASE("texts are eight tenths of a degree high unless the protocol says otherwise", "[unit]") {
    CHECK(ScreenSettings().text_height_deg >= 0.8);
}
