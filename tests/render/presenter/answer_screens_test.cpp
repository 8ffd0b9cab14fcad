/// Answers on the screen: nothing meets, nothing moves, and what is touched is what was drawn there.
#include "render/presenter/screen_text.h"

#include <algorithm>
#include <filesystem>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/render/presenter/answer_examples.h"
#include "tests/render/presenter/apart_texts.h"
#include "tests/render/presenter/presenter_bench.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

namespace {

ScreenGeometry answer_screen_of(glm::ivec2 screen_px) {
    ScreenGeometry geometry;
    geometry.screen_px = screen_px;
    geometry.screen_mm = 0.36 * glm::dvec2(screen_px);
    return geometry;
}

PlacedPicture answers_drawn(const Screen& screen, glm::ivec2 screen_px = {1920, 1080}) {
    return draw_screen(screen, answer_screen_of(screen_px), {}, 0.2);
}

Screen answering(std::vector<AnswerItem> items) {
    Screen screen{.kind = Screen::Kind::answers, .text = ""};
    screen.answers.items = std::move(items);
    return screen;
}

glm::dvec2 middle_of(const InkBox& box) { return {box.x + 0.5 * box.width, box.y + 0.5 * box.height}; }

} // namespace

TEST_CASE("texts of answers stand apart and on the screen, in each language and on a small screen",
          "[unit]") {
    for (const glm::ivec2 size : {glm::ivec2(1920, 1080), glm::ivec2(800, 600)})
        for (const AnswerWords& words : answer_languages())
            for (const auto& [name, screen] : answer_examples(words)) {
                CAPTURE(name, size.x);
                check_texts(answers_drawn(screen, size), size);
            }
}

TEST_CASE("nothing moves while it is answered", "[unit]") {
    for (const AnswerWords& words : {answer_languages().front(), answer_languages().back()}) {
        const auto before = answer_examples(words, false), after = answer_examples(words, true);
        for (std::size_t i = 0; i < before.size(); ++i) {
            CAPTURE(before[i].first);
            const auto empty = answers_drawn(before[i].second).targets,
                       given = answers_drawn(after[i].second).targets;
            REQUIRE(empty.size() == given.size());
            for (std::size_t t = 0; t < empty.size(); ++t) {
                CHECK(empty[t].box.x == given[t].box.x);
                CHECK(empty[t].box.y == given[t].box.y);
                CHECK(empty[t].from == given[t].from);
            }
        }
    }
}

TEST_CASE("each option is found where it was drawn, and nothing beside it", "[unit]") {
    for (const AnswerWords& words : {answer_languages().back()})
        for (const auto& [name, screen] : answer_examples(words)) {
            CAPTURE(name);
            const std::vector<AnswerTarget> targets = answers_drawn(screen).targets;
            for (const AnswerTarget& target : targets) {
                const AnswerPlace place = place_among(targets, middle_of(target.box));
                CHECK(place.item == target.place.item);
                CHECK(place.option == target.place.option);
                CHECK(place.is_accept == target.place.is_accept);
            }
            std::size_t things = screen.answers.accept.empty() ? 0 : 1;
            for (const AnswerItem& item : screen.answers.items)
                things +=
                    item.kind == AnswerItem::Kind::notice ? 0 : std::max<std::size_t>(1, item.options.size());
            CHECK(targets.size() == things);
            const AnswerPlace nowhere = place_among(targets, {1.0, 1.0});
            CHECK(nowhere.item == -1);
            CHECK_FALSE(nowhere.is_accept);
        }
}

TEST_CASE("a line tells how far along it was touched, also a little beyond its ends", "[unit]") {
    AnswerItem line{.kind = AnswerItem::Kind::line, .question = "How glossy?"};
    line.ends = {"matte", "glossy"};
    const std::vector<AnswerTarget> targets = answers_drawn(answering({line})).targets;
    REQUIRE(targets.size() == 1);
    REQUIRE(targets[0].from);
    const double left = *targets[0].from, length = *targets[0].over, y = middle_of(targets[0].box).y;
    CHECK(length > 400.0);
    CHECK(place_among(targets, {left, y}).along == 0.0);
    CHECK(place_among(targets, {left + 0.25 * length, y}).along == Approx(0.25));
    CHECK(place_among(targets, {left + length + 5.0, y}).along == 1.0);
    CHECK_FALSE(place_among(targets, {left + 0.5 * length, y - targets[0].box.height}).along);
    // Its ink is where it says: in the column of the marker there is more of it than beside it.
    line.marker = 0.25;
    const PlacedPicture drawn = answers_drawn(answering({line}));
    const auto ink_in = [&](double column) {
        double sum = 0.0;
        const int x = static_cast<int>(column) - drawn.origin_px.x;
        const InkBox& box = drawn.targets[0].box;
        for (int row = static_cast<int>(box.y); row < static_cast<int>(box.y + box.height); ++row)
            sum += drawn.picture.at(x, row - drawn.origin_px.y).w;
        return sum;
    };
    CHECK(ink_in(left + 0.25 * length) > 4.0 * ink_in(left + 0.4 * length));
}

TEST_CASE("words too wide for their steps stand below each other", "[unit]") {
    AnswerItem steps{.kind = AnswerItem::Kind::steps, .question = "Agreed?"};
    for (const char* const word :
         {"Donaudampfschifffahrtsgesellschaft", "Rindfleischetikettierung", "so", "ja"})
        steps.options.push_back({word, "", "", false});
    const std::vector<AnswerTarget> wide = answers_drawn(answering({steps}), {800, 600}).targets;
    REQUIRE(wide.size() == 4);
    CHECK(wide[0].box.x == wide[3].box.x);
    CHECK(wide[0].box.y < wide[1].box.y);
    for (AnswerOption& option : steps.options)
        option.label = "1";
    const std::vector<AnswerTarget> narrow = answers_drawn(answering({steps}), {800, 600}).targets;
    CHECK(narrow[0].box.x < narrow[3].box.x);
    CHECK(narrow[0].box.y == narrow[3].box.y);
}

TEST_CASE("a choice shows its pictures, in their colours", "[unit]") {
    const TemporaryFolder folder;
    std::vector<AnswerOption> options;
    for (const glm::vec3 colour : {glm::vec3(1.0f, 0.0f, 0.0f), glm::vec3(0.0f, 0.0f, 1.0f)}) {
        LinearImage picture({40, 20});
        std::ranges::fill(picture.pixels, glm::vec4(colour, 1.0f));
        const std::string file = folder.path() / fmt::format("{}.png", options.size());
        write_srgb_png(file, picture);
        options.push_back({"one", "", file, false});
    }
    const PlacedPicture drawn = answers_drawn(answering({choice_of("Which?", options)}));
    REQUIRE(drawn.targets.size() == 2);
    const auto in_the_middle = [&](int option) {
        const InkBox& box = drawn.targets[static_cast<std::size_t>(option)].box;
        // Above the label.
        const glm::ivec2 at =
            glm::ivec2(box.x + 0.5 * box.width, box.y + 0.35 * box.height) - drawn.origin_px;
        return glm::vec3(drawn.picture.at(at.x, at.y));
    };
    CHECK(in_the_middle(0).r > 0.9f);
    CHECK(in_the_middle(0).b < 0.1f);
    CHECK(in_the_middle(1).b > 0.9f);
    options[0].picture = (folder.path() / "none.png").string();
    CHECK_THROWS_AS(answers_drawn(answering({choice_of("Which?", options)})), InputError);
}

TEST_CASE("what is right is green and what is wrong is red, both as bright as any text", "[unit]") {
    const auto words = answer_languages().front();
    for (const auto& [name, screen] : answer_examples(words)) {
        if (!name.ends_with("good") && !name.ends_with("bad"))
            continue;
        const LinearImage picture = answers_drawn(screen).picture;
        glm::vec3 ink(0.0f);
        for (const glm::vec4& pixel : picture.pixels)
            if (pixel.w > 0.99f)
                ink = glm::vec3(pixel);
        CHECK((ink.g > ink.r) == name.ends_with("good"));
        CHECK(ink.r != ink.b);
    }
}

TEST_CASE("a text that is longer than its box shows the lines around the caret", "[unit]") {
    TextStyle style;
    style.line_height_px = 20;
    style.wrap_width_px = 200;
    style.centred = false;
    std::string text;
    for (int i = 0; i < 40; ++i)
        text += "word ";
    const TextPart end = lines_around(text, style, text.size(), 3), begin = lines_around(text, style, 0, 3);
    CHECK(begin.begin == 0);
    CHECK(end.end == text.size());
    CHECK(end.begin > begin.end);
    CHECK(measure_text(text.substr(end.begin), style).lines == 3);
    const TextPart all = lines_around("short", style, 2, 3);
    CHECK(all.begin == 0);
    CHECK(all.end == 5);
    CHECK(lines_around("", style, 0, 3).end == 0);
}

TEST_CASE("the presenter says what of the answers on its screen lies at a place, from the middle", "[gl]") {
    Bench bench;
    bench.geometry.screen_px = {640, 360};
    bench.geometry.screen_mm = {230.0, 130.0};
    bench.geometry.image_origin_px = {304, 164};
    PagePresenter presenter(*bench.context, bench.display, bench.pages, bench.geometry, bench.settings,
                            bench.screens);
    const Screen screen =
        answering({choice_of("Which?", {{"first", "f", "", false}, {"second", "j", "", false}})});
    presenter.show(screen);
    const std::vector<AnswerTarget> targets =
        draw_screen(screen, bench.geometry, bench.screens, bench.settings.background).targets;
    REQUIRE(targets.size() == 2);
    const glm::dvec2 at = middle_of(targets[1].box) - 0.5 * glm::dvec2(bench.geometry.screen_px);
    CHECK(presenter.place_in_answers(at.x, at.y).option == 1);
    CHECK(presenter.place_in_answers(-319.0, -179.0).item == -1);
    // On another screen nothing of them is left.
    presenter.show({.kind = Screen::Kind::blank, .text = ""});
    CHECK(presenter.place_in_answers(at.x, at.y).item == -1);
}

TEST_CASE("answers stand beside a stimulus, which covers what of them is in its place", "[gl]") {
    Bench bench;
    bench.geometry.screen_px = {640, 360};
    bench.geometry.screen_mm = {230.0, 130.0};
    bench.geometry.image_origin_px = {304, 164};
    bench.screens.text_height_deg = 0.2; // there is room for them below the stimulus
    PagePresenter presenter(*bench.context, bench.display, bench.pages, bench.geometry, bench.settings,
                            bench.screens);
    const auto bright_rows = [&](int first, int end) {
        const std::vector<std::byte> canvas = presenter.read_canvas();
        int bright = 0;
        for (int y = first; y < end; ++y)
            for (int x = 0; x < 640; ++x)
                bright += std::to_integer<int>(canvas[static_cast<std::size_t>(y * 640 + x) * 4 + 2]) > 60;
        return bright;
    };
    presenter.load_frames({});
    AnswerView answers;
    answers.items = {choice_of("", {{"first", "f", "", false}, {"second", "j", "", false}})};
    answers.up_deg = -3.0; // far enough below the middle
    presenter.put_beside_stimuli(&answers);
    presenter.flip({1});
    CHECK(bright_rows(210, 360) > 50); // words and boxes
    CHECK(bright_rows(164, 196) == 0); // beside the stimulus there is nothing
    const std::vector<std::byte> canvas = presenter.read_canvas();
    CHECK(std::to_integer<int>(canvas[(180 * 640 + 320) * 4]) == 2); // page 1 in its place
    Screen screen{.kind = Screen::Kind::answers, .text = ""};
    screen.answers = answers;
    const auto targets =
        draw_screen(screen, bench.geometry, bench.screens, bench.settings.background).targets;
    const glm::dvec2 at = middle_of(targets[0].box) - 0.5 * glm::dvec2(bench.geometry.screen_px);
    CHECK(presenter.place_in_answers(at.x, at.y).option == 0);
    // A frame that is empty leaves them there, and so do further ones.
    presenter.flip(no_frame);
    presenter.flip({2});
    CHECK(bright_rows(210, 360) > 50);
    presenter.put_beside_stimuli(nullptr);
    presenter.flip({1});
    CHECK(bright_rows(0, 360) == 0);
    CHECK(presenter.place_in_answers(at.x, at.y).option == -1);
}
