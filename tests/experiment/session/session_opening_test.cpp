/// Consent, form and instructions, on ports that do what they are told.
#include "experiment/base/content_hash.h"
#include "experiment/session/observer_form.h"
#include "tests/experiment/record/plain_session.h"
#include "tests/support/observer_fields.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

using Key = ResponsePress::Key;

bool take(ObserverForm& form, std::u32string_view typed) {
    for (const char32_t character : typed)
        form.take({Key::character, {}, character});
    return form.take({Key::next, {}});
}

} // namespace

TEST_CASE("who agrees is recorded with the hash of the text, before anything else of the observer",
          "[unit]") {
    Sitting sitting(short_protocol("[consent]\ntext = \"Do you agree? J/N\"\naccept_key = \"j\"\n"));
    CHECK(sitting.run().completed_trials == 2);
    REQUIRE(sitting.log.consents.size() == 1);
    const RecordedConsent& consent = sitting.log.consents[0];
    CHECK(consent.accepted);
    CHECK(consent.observer == "P1");
    CHECK(consent.text_sha256 == hash_of_text("Do you agree? J/N"));
    CHECK(to_seconds(consent.at - SessionTime{}) > 0.0);
}

TEST_CASE("who declines ends the session, and nothing but that is recorded", "[unit]") {
    Sitting sitting(
        short_protocol("[consent]\ntext = \"Do you agree?\"\n[[observer_field]]\nid = \"age\"\n"));
    sitting.fields = {"31"};
    sitting.panel.tell = [](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        return panel.is_deciding() ? std::optional(ResponsePress{Key::no, {}}) : std::nullopt;
    };
    const SessionResult result = sitting.run();
    CHECK(result.aborted);
    CHECK_THAT(result.reason, Contains("declined"));
    REQUIRE(sitting.log.consents.size() == 1);
    CHECK_FALSE(sitting.log.consents[0].accepted);
    CHECK(sitting.log.fields.empty());
    CHECK(sitting.log.started.empty());
    CHECK(sitting.tracker.calibrations == 0);
    CHECK(sitting.log.kinds == std::vector<std::string>{"phase", "phase", "session aborted"});
}

TEST_CASE("instructions are read page by page, there and back", "[unit]") {
    Sitting sitting(short_protocol("[screens]\nwelcome_text = \"\"\n"
                                   "[instructions]\npages = [\"one\", \"two\", \"three\"]\n"));
    const std::vector<Key> keys{Key::back, Key::next, Key::next, Key::back, Key::next, Key::next};
    std::size_t pressed = 0;
    sitting.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        return panel.phase() == SessionPhase::set_up && pressed < keys.size()
                   ? std::optional(ResponsePress{keys[pressed++], {}})
                   : std::nullopt;
    };
    CHECK(sitting.run().completed_trials == 2);
    std::string seen;
    for (const Screen& screen : sitting.presenter.screens) {
        if (screen.pages == 0)
            continue;
        seen += fmt::format("{} {} ", screen.text, screen.page);
        // Back is said where there is something to go back to.
        CHECK(screen.keys.size() == (screen.page == 1 ? 1u : 2u));
    }
    CHECK(seen == "one 1 one 1 two 2 three 3 two 2 three 3 ");
}

TEST_CASE("a form is filled in by keys, and says what is at fault", "[unit]") {
    const auto fields = three_observer_fields("name");
    ObserverForm form(fields, {});
    // What cannot be is said at once, where it was typed.
    CHECK_FALSE(take(form, U"3x1"));
    CHECK(form.focus() == 0);
    CHECK_THAT(form.message(), Contains("\"3x1\""));
    CHECK(form.screen().rows[0].is_at_fault);
    form.take({Key::down, {}});
    CHECK(form.focus() == 1);
    CHECK(form.screen().rows[0].is_at_fault);
    CHECK_FALSE(form.screen().rows[1].is_at_fault);
    CHECK(form.screen().rows[1].choices.size() == 3);
    form.take({Key::right, {}});
    CHECK(form.values()[1] == "left");
    form.take({Key::left, {}});
    CHECK(form.values()[1] == "ambidextrous");
    form.take({Key::character, {}, U'R'});
    CHECK(form.values()[1] == "right");
    CHECK_FALSE(form.take({Key::next, {}}));
    CHECK_FALSE(take(form, U"Zoë 王\u0301"));
    // The first fault is said and gone to.
    CHECK(form.focus() == 0);
    CHECK_THAT(form.message(), Contains("\"3x1\""));
    CHECK_THAT(form.screen().text, Contains(form.message()));
    CHECK(form.screen().rows[0].label == "Age in years");
    CHECK(form.screen().rows[0].is_here);
    form.take({Key::erase, {}});
    form.take({Key::erase, {}});
    CHECK(form.values()[0] == "3");
    CHECK(form.message().empty());
    form.take({Key::up, {}});
    CHECK(form.focus() == 2);
    form.take({Key::erase, {}});
    form.take({Key::erase, {}});
    CHECK(form.values()[2] == "Zoë ");
    CHECK(form.take({Key::next, {}}));
    CHECK(form.values() == FieldValues{"3", "right", "Zoë"});
}

TEST_CASE("characters that are no text are not typed, and a stuck key fills no memory", "[unit]") {
    const auto fields = three_observer_fields("name");
    ObserverForm form(fields, {});
    for (const char32_t no_text :
         {char32_t{0}, U'\n', char32_t{0x7F}, char32_t{0x85}, char32_t{0xD800}, char32_t{0x110000}})
        form.take({Key::character, {}, no_text});
    CHECK(form.values()[0].empty());
    for (int i = 0; i < 10000; ++i)
        form.take({Key::character, {}, U'\U0001F600'});
    CHECK(form.values()[0].size() <= 404);
    for (int i = 0; i < 200; ++i)
        form.take({Key::erase, {}});
    CHECK(form.values()[0].empty());
}

TEST_CASE("the session shows the form where somebody can type, with what is known, and records it",
          "[unit]") {
    Sitting sitting(short_protocol("[[observer_field]]\nid = \"age\"\n[[observer_field]]\nid = \"sex\"\n"));
    sitting.fields = {"", "male"};
    const std::u32string typed = U"200";
    std::size_t next = 0;
    bool is_corrected = false;
    sitting.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        if (!panel.is_typing())
            return std::nullopt;
        if (next < typed.size())
            return ResponsePress{Key::character, {}, typed[next++]};
        if (!is_corrected && sitting.presenter.texts.back().find("\"200\"") != std::string::npos) {
            is_corrected = true;
            return ResponsePress{Key::erase, {}};
        }
        return std::nullopt;
    };
    CHECK(sitting.run().completed_trials == 2);
    CHECK(is_corrected);
    REQUIRE(sitting.log.fields.size() == 2);
    for (RecordedObserverField& field : sitting.log.fields) {
        CHECK(field.at > SessionTime{});
        field.at.reset();
    }
    CHECK(sitting.log.fields ==
          std::vector<RecordedObserverField>{{"age", "Age in years", "20"}, {"sex", "Sex", "male"}});
    // Where all is known nobody is asked.
    Sitting known(short_protocol("[[observer_field]]\nid = \"age\"\n"));
    known.fields = {"44"};
    CHECK(known.run().completed_trials == 2);
    CHECK(known.log.fields.size() == 1);
    for (const std::string& text : known.presenter.texts)
        CHECK(text.find("Age in years") == std::string::npos);
}

TEST_CASE("a form's rows say what each field is, where it is filled in, and what is at fault", "[unit]") {
    std::vector<ObserverFieldSettings> fields(3);
    fields[0].id = "age";
    fields[0].title = "Age";
    fields[0].kind = FieldKind::number;
    fields[1].id = "hand";
    fields[1].title = "Hand";
    fields[1].kind = FieldKind::choice;
    fields[1].choices = {"left", "right"};
    fields[1].required = false;
    fields[1].note = "Which do you write with?";
    fields[2].id = "remarks";
    fields[2].title = "Remarks";
    fields[2].required = false;
    for (ObserverFieldSettings& field : fields)
        complete_field(field, field.kind == FieldKind::choice);
    fields[2].kind = FieldKind::text;
    ObserverForm form(fields, {}, {});
    const auto hints = [&] {
        std::string all;
        for (const KeyHint& hint : form.screen().keys)
            all += "[" + hint.key + "|" + hint.does + "]";
        return all;
    };
    Screen screen = form.screen();
    CHECK(screen.kind == Screen::Kind::form);
    REQUIRE(screen.rows.size() == 3);
    CHECK(screen.rows[0].label == "Age");
    CHECK(screen.rows[1].label == "Hand (optional)");
    CHECK(screen.rows[0].choices.empty());
    CHECK(screen.rows[1].choices == std::vector<std::string>{"left", "right"});
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(screen.rows[i].is_here == (i == 0));
        CHECK_FALSE(screen.rows[i].is_at_fault);
    }
    CHECK(screen.page == 1);
    CHECK(screen.pages == 3);
    CHECK(hints() == "[↑ ↓|other fields][enter|next]");
    // What is empty is not at fault before it is said to be.
    form.take({Key::down, {}});
    CHECK_FALSE(form.screen().rows[0].is_at_fault);
    form.take({Key::up, {}});
    // What cannot be is at fault once it is left, or said to be.
    for (const char32_t letter : std::u32string_view(U"500"))
        form.take({Key::character, {}, letter});
    CHECK_FALSE(form.screen().rows[0].is_at_fault);
    form.take({Key::down, {}});
    screen = form.screen();
    CHECK(screen.rows[0].is_at_fault);
    CHECK(screen.rows[0].value == "500");
    CHECK(screen.rows[1].is_here);
    CHECK_FALSE(screen.rows[1].is_at_fault);
    CHECK(screen.page == 2);
    CHECK_THAT(screen.text, Contains("Which do you write with?"));
    CHECK(hints() == "[← →|choose][↑ ↓|other fields][enter|next]");
    form.take({Key::right, {}});
    CHECK(form.values()[1] == "left");
    form.take({Key::right, {}});
    CHECK(form.values()[1] == "right");
    form.take({Key::right, {}});
    CHECK(form.values()[1] == "left");
    form.take({Key::left, {}});
    CHECK(form.values()[1] == "right");
    form.take({Key::character, {}, U'L'});
    CHECK(form.values()[1] == "left");
    form.take({Key::character, {}, U' '});
    CHECK(form.values()[1] == "right");
    form.take({Key::erase, {}});
    CHECK(form.values()[1].empty());
    form.take({Key::left, {}});
    CHECK(form.values()[1] == "right"); // the last
    form.take({Key::down, {}});
    CHECK(form.focus() == 2);
    CHECK(hints() == "[↑ ↓|other fields][enter|done]");
    form.take({Key::down, {}});
    CHECK(form.focus() == 0); // round
    form.take({Key::up, {}});
    CHECK(form.focus() == 2);
    // Submitted with a fault it goes there and says so; "<" and "&" are no emphasis.
    CHECK_FALSE(form.take({Key::next, {}}));
    CHECK(form.focus() == 0);
    CHECK(form.screen().rows[0].is_at_fault);
    CHECK_THAT(form.message(), Catch::StartsWith("Age: \"500\": this cannot be  "));
    for (int i = 0; i < 3; ++i)
        form.take({Key::erase, {}});
    CHECK(form.message().empty());
    for (const char32_t letter : std::u32string_view(U"<&"))
        form.take({Key::character, {}, letter});
    CHECK_FALSE(form.take({Key::next, {}}));
    CHECK_THAT(form.message(), Contains("\"&lt;&amp;\""));
    form.take({Key::erase, {}});
    form.take({Key::erase, {}});
    for (const char32_t letter : std::u32string_view(U" 31 "))
        form.take({Key::character, {}, letter});
    CHECK_FALSE(form.take({Key::next, {}}));
    CHECK(form.focus() == 1);
    CHECK(form.values()[0] == "31");
    CHECK_FALSE(form.take({Key::next, {}}));
    CHECK(form.focus() == 2);
    CHECK(form.take({Key::next, {}}));
}

TEST_CASE("characters at the edges of what is text are typed, or not", "[unit]") {
    std::vector<ObserverFieldSettings> fields(1);
    fields[0].id = fields[0].title = "name";
    complete_field(fields[0], false);
    fields[0].kind = FieldKind::text;
    const std::pair<char32_t, bool> edges[] = {{0x1F, false},  {0x20, true},     {0x7E, true},
                                               {0x7F, false},  {0x9F, false},    {0xA0, true},
                                               {0xD7FF, true}, {0xD800, false},  {0xDFFF, false},
                                               {0xE000, true}, {0x10FFFF, true}, {0x110000, false}};
    for (const auto& [character, is_typed] : edges) {
        CAPTURE(static_cast<unsigned>(character));
        ObserverForm form(fields, {}, {});
        form.take({Key::character, {}, character});
        CHECK(form.values()[0].empty() != is_typed);
        form.take({Key::erase, {}});
        CHECK(form.values()[0].empty()); // with all its bytes
    }
    ObserverForm form(fields, {}, {});
    for (int i = 0; i < 450; ++i)
        form.take({Key::character, {}, U'a'});
    CHECK(form.values()[0].size() == 400);
}

TEST_CASE("a form begins at its first empty field, and letters go round the choices that begin with them",
          "[unit]") {
    std::vector<ObserverFieldSettings> fields(3);
    for (std::size_t i = 0; i < 3; ++i) {
        fields[i].id = fields[i].title = "field_" + std::to_string(i);
        fields[i].kind = FieldKind::choice;
        fields[i].choices = {"Ada", "Bea", "Abe", "Amy"};
        complete_field(fields[i], true);
    }
    CHECK(ObserverForm(fields, {"Ada", "", ""}, {}).focus() == 1);
    CHECK(ObserverForm(fields, {"", "Bea", ""}, {}).focus() == 0);
    CHECK(ObserverForm(fields, {"Ada", "Bea", "Amy"}, {}).focus() == 0);
    ObserverForm form(fields, {}, {});
    std::vector<std::string> seen;
    for (int i = 0; i < 4; ++i) {
        form.take({Key::character, {}, U'a'});
        seen.push_back(form.values()[0]);
    }
    CHECK(seen == std::vector<std::string>{"Ada", "Abe", "Amy", "Ada"});
    form.take({Key::character, {}, U'z'});
    CHECK(form.values()[0] == "Ada");
}

TEST_CASE("a form of one field names no other fields, and its only key submits it", "[unit]") {
    std::vector<ObserverFieldSettings> fields(1);
    fields[0].id = fields[0].title = "name";
    complete_field(fields[0], false);
    fields[0].kind = FieldKind::text;
    fields[0].required = true;
    ObserverForm form(fields, {}, {});
    REQUIRE(form.screen().keys.size() == 1);
    CHECK(form.screen().keys[0].does == "done");
    CHECK_FALSE(form.take({Key::next, {}}));
    form.take({Key::character, {}, U'x'});
    CHECK(form.take({Key::next, {}}));
}
