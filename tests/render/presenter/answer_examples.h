/// Screens of answers of every kind, in three languages.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiment/ports/presenter.h"

namespace overt::test {

/// The words of one language.
struct AnswerWords {
    std::string name, question, first, second, long_choice, scale_question, left_end, right_end,
        number_question, unit, text_question, typed, good, bad, accept, missing;
    std::vector<std::string> degrees; ///< of agreement
};

inline std::vector<AnswerWords> answer_languages() {
    return {{"english",
             "Which object is <b>glossier</b>?",
             "first",
             "second",
             "neither of them, as far as I can tell",
             "How glossy was the object?",
             "not at all",
             "like a mirror",
             "How heavy is it?",
             "kg",
             "What did you think of while you looked?",
             "It reminded me of a fish that I once saw at the market, or rather of its shadow on the wall.",
             "Right",
             "Wrong",
             "Go on",
             "Please choose an answer.",
             {"strongly disagree", "disagree", "neither agree nor disagree", "agree", "strongly agree"}},
            {"german",
             "Welches Objekt ist <b>glänzender</b>?",
             "das erste",
             "das zweite",
             "keines von beiden, soweit ich es beurteilen kann",
             "Wie glänzend war das Objekt?",
             "überhaupt nicht glänzend",
             "wie ein Spiegel",
             "Wie schwer ist es?",
             "kg",
             "Woran haben Sie beim Betrachten gedacht?",
             "An eine Geschwindigkeitsbeschränkung auf der Rheinbrücke.",
             "Richtig",
             "Falsch",
             "Weiter",
             "Bitte wählen Sie eine Antwort.",
             {"stimme überhaupt nicht zu", "stimme nicht zu", "unentschieden", "stimme zu",
              "stimme voll und ganz zu"}},
            {"arabic",
             "أي الجسمين <b>أكثر لمعانا</b>؟",
             "الأول",
             "الثاني",
             "لا هذا ولا ذاك على حد علمي",
             "ما مدى لمعان الجسم؟",
             "غير لامع على الإطلاق",
             "كالمرآة",
             "كم يزن؟",
             "كغ",
             "بماذا فكرت أثناء النظر؟",
             "ذكرني بسمكة رأيتها ذات مرة في السوق، أو بالأحرى بظلها على الجدار في ذلك الصباح البارد.",
             "صحيح",
             "خطأ",
             "متابعة",
             "يرجى اختيار إجابة.",
             {"لا أوافق بشدة", "لا أوافق", "محايد", "أوافق", "أوافق بشدة"}}};
}

inline AnswerItem choice_of(const std::string& question, std::vector<AnswerOption> options) {
    return {.kind = AnswerItem::Kind::choice, .question = question, .options = std::move(options)};
}

/// Of one language; `is_given`: something was answered already.
inline std::vector<std::pair<std::string, Screen>> answer_examples(const AnswerWords& words,
                                                                   bool is_given = true) {
    const bool is_rtl = words.name == "arabic";
    std::vector<std::pair<std::string, Screen>> all;
    const auto add = [&](std::string name, std::vector<AnswerItem> items, bool has_button = false) {
        Screen screen{.kind = Screen::Kind::answers, .text = ""};
        screen.answers.items = std::move(items);
        if (has_button) {
            screen.answers.accept = words.accept;
            screen.answers.can_accept = is_given;
        }
        all.emplace_back(words.name + "_" + name, std::move(screen));
    };
    std::vector<AnswerOption> two = {{words.first, "left", "", is_given}, {words.second, "right", "", false}};
    add("choice", {choice_of(words.question, two)});
    AnswerItem missing =
        choice_of(words.question, {{words.first, "f", "", false}, {words.second, "j", "", false}});
    missing.message = is_given ? words.missing : "";
    add("choice_missing", {missing});
    add("choice_long", {choice_of(words.question, {{words.long_choice, "1", "", false},
                                                   {words.long_choice, "2", "", is_given},
                                                   {words.first, "3", "", false},
                                                   {words.second, "4", "", false}})});
    AnswerItem likert{.kind = AnswerItem::Kind::steps, .question = words.scale_question};
    for (int i = 1; i <= 7; ++i)
        likert.options.push_back(
            {std::to_string(is_rtl ? 8 - i : i), std::to_string(is_rtl ? 8 - i : i), "", is_given && i == 3});
    likert.ends =
        is_rtl ? std::vector{words.right_end, words.left_end} : std::vector{words.left_end, words.right_end};
    likert.is_right_to_left = is_rtl;
    add("steps_numbers", {likert});
    AnswerItem agreement{.kind = AnswerItem::Kind::steps, .question = words.scale_question};
    for (const std::string& degree : words.degrees)
        agreement.options.push_back({degree, "", "", is_given && agreement.options.size() == 1});
    if (is_rtl)
        std::ranges::reverse(agreement.options);
    add("steps_labels", {agreement});
    AnswerItem bare{.kind = AnswerItem::Kind::steps, .question = ""};
    bare.options.resize(5);
    bare.options[4].is_chosen = is_given;
    bare.ends = likert.ends;
    add("steps_bare", {bare});
    AnswerItem line{.kind = AnswerItem::Kind::line, .question = words.scale_question};
    line.ends = likert.ends;
    line.ticks = 11;
    if (is_given)
        line.marker = 0.97;
    line.marker_label = is_given ? "97" : "";
    add("line", {line}, true);
    AnswerItem number{.kind = AnswerItem::Kind::number, .question = words.number_question};
    number.typed = is_given ? "12.5" : "";
    number.caret = number.typed.size();
    number.unit = words.unit;
    add("number", {number}, true);
    AnswerItem text{.kind = AnswerItem::Kind::text, .question = words.text_question};
    text.typed = is_given ? words.typed + " " + words.typed + " " + words.typed : "";
    text.caret = text.typed.size();
    add("text", {text}, true);
    AnswerItem here = line, there = number, last = likert;
    here.is_here = true;
    there.is_here = last.is_here = false;
    last.message = is_given ? words.missing : "";
    here.ticks = 0;
    add("several", {here, there, last}, true);
    for (const bool good : {true, false})
        add(good ? "good" : "bad", {{.kind = AnswerItem::Kind::notice,
                                     .question = good ? words.good : words.bad,
                                     .colour = good ? AnswerItem::Colour::good : AnswerItem::Colour::bad}});
    AnswerItem keys{.kind = AnswerItem::Kind::keys, .question = words.question, .options = two};
    keys.options[0].is_chosen = false;
    add("keys", {keys});
    return all;
}

} // namespace overt::test
