/// What the program itself says, in the language of the lab.
#include "experiment/session/observer_form.h"
#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

TEST_CASE("the operator is asked in the protocol's words, and the record keeps them", "[unit]") {
    Sitting sitting(
        short_protocol("[words]\nskip = \"この試行を飛ばしますか？\"\nyes = \"はい\"\nno = \"いいえ\"\n"
                       "[operator]\nskip_reasons = [\"視線なし\"]\n"));
    bool is_pressed = false;
    sitting.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        if (panel.is_deciding())
            return ResponsePress{ResponsePress::Key::character, {}, U'1'};
        if (panel.phase() != SessionPhase::task_screen || is_pressed)
            return std::nullopt;
        is_pressed = true;
        return ResponsePress{ResponsePress::Key::skip, {}};
    };
    CHECK(sitting.run().completed_trials == 1);
    CHECK_THAT(sitting.presenter.texts,
               Catch::VectorContains(std::string("この試行を飛ばしますか？\n\n1: はい, 視線なし")));
    CHECK_THAT(sitting.log.details_of("operator asked").at(0), Contains("この試行を飛ばしますか？"));
    // It is framed, with the words of its keys; what the observer reads is not.
    int framed = 0;
    for (const Screen& screen : sitting.presenter.screens) {
        framed += !screen.frame.empty();
        if (!screen.frame.empty()) {
            REQUIRE(screen.keys.size() == 2);
            CHECK(screen.keys[0].key == "Y");
            CHECK(screen.keys[1].does == "いいえ");
        }
    }
    CHECK(framed == 1);
}

TEST_CASE("every question has words of its own", "[unit]") {
    using Key = ResponsePress::Key;
    const std::pair<Key, const char*> questions[] = {{Key::recalibrate, "recalibrate"},
                                                     {Key::repeat, "repeat"},
                                                     {Key::reject, "reject"},
                                                     {Key::skip, "skip"},
                                                     {Key::abort, "abort_in_trial"}};
    for (const auto& [key, word] : questions) {
        CAPTURE(word);
        Sitting sitting(short_protocol(fmt::format("[words]\n{} = \"سؤال؟\"\n", word)));
        bool is_pressed = false;
        sitting.panel.tell = [&, key = key](ScriptedPanel& panel) -> std::optional<ResponsePress> {
            if (panel.is_deciding())
                return ResponsePress{Key::no, {}};
            if (panel.phase() != SessionPhase::task_screen || is_pressed)
                return std::nullopt;
            is_pressed = true;
            return ResponsePress{key, {}};
        };
        CHECK(sitting.run().completed_trials == 2);
        CHECK_THAT(sitting.log.details_of("operator asked").at(0), Contains("سؤال؟"));
    }
}

namespace {

/// All words of a screen.
std::string said_in(const Screen& screen) {
    std::string said = screen.text;
    for (const FormRow& row : screen.rows) {
        said += "\n" + row.label + " " + row.value;
        for (const std::string& choice : row.choices)
            said += " " + choice;
    }
    for (const KeyHint& hint : screen.keys)
        said += "\n" + hint.key + " " + hint.does;
    return said;
}

} // namespace

TEST_CASE("the form speaks the protocol's words and no others", "[unit]") {
    std::vector<ObserverFieldSettings> fields(2);
    fields[0].id = "age";
    fields[0].title = "العمر";
    fields[1].id = "hand";
    fields[1].title = "اليد";
    fields[1].choices = {"يمنى", "يسرى"};
    fields[1].kind = FieldKind::choice;
    fields[1].required = false;
    for (ObserverFieldSettings& field : fields)
        complete_field(field, field.kind == FieldKind::choice);
    WordSettings words;
    words.optional = "اختياري";
    words.choose = "اختر";
    words.back = "رجوع";
    words.other_fields = "حقول أخرى";
    words.next = "التالي";
    words.done = "تم";
    words.missing = "يرجى ملء هذا";
    words.not_possible = "غير ممكن";
    words.form_title = "عنك";
    words.enter_key = "إدخال";
    ObserverForm form(fields, {}, words);
    const auto has_latin = [](const std::string& text) {
        return std::any_of(text.begin(), text.end(), [](char c) { return (c >= 'a' && c <= 'z'); });
    };
    CHECK_FALSE(has_latin(said_in(form.screen())));
    form.take({ResponsePress::Key::down, {}});
    CHECK_THAT(said_in(form.screen()), Contains("اختر") && Contains("تم"));
    CHECK_FALSE(form.take({ResponsePress::Key::next, {}}));
    CHECK(form.message() == "العمر: يرجى ملء هذا  0 … 120");
    form.take({ResponsePress::Key::character, {}, U'x'});
    CHECK_FALSE(form.take({ResponsePress::Key::next, {}}));
    CHECK(form.message() == "العمر: \"x\": غير ممكن  0 … 120");
    form.take({ResponsePress::Key::erase, {}});
    CHECK_FALSE(has_latin(said_in(form.screen())));
}

TEST_CASE("every screen says how to go on, and none is blank while the session is at work", "[unit]") {
    Sitting sitting(
        short_protocol("[consent]\ntext = \"Agree?\"\naccept_key = \"j\"\n[screens]\nrepeat_question = true\n"
                       "[breaks]\nevery_trials = 1\nmin_s = 7\ntext = \"Rest.\"\n"
                       "[words]\nrest = \"keys in {} s\"\nclose = \"shut\"\n"));
    CHECK(sitting.run().completed_trials == 2);
    const std::vector<Screen>& screens = sitting.presenter.screens;
    REQUIRE(screens.size() > 6);
    CHECK(screens[0].keys[0].key == "J");
    CHECK(screens[0].keys.size() == 2);
    int waiting = 0, asleep = 0, awake = 0;
    const std::string& question = sitting.protocol.tasks[0].question;
    int questions = 0;
    for (const Screen& screen : screens) {
        waiting += screen.text == sitting.protocol.words.please_wait;
        questions += screen.text.starts_with(question);
        if (screen.text == "Rest.") {
            REQUIRE(screen.keys.size() == 1);
            asleep += screen.keys[0].key.empty() && screen.keys[0].does == "keys in 7 s";
            awake += screen.keys[0].key == "space bar";
        }
        CHECK(screen.frame.empty());
    }
    CHECK(waiting == 1);
    CHECK(asleep == 1);
    CHECK(awake == 1);
    CHECK(questions == 4); // before and after each animation
    CHECK(screens.back().keys.at(0).does == "shut");
}
