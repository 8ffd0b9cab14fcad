#include "experiment/study/tables/answers_json.h"

#include <algorithm>
#include <map>
#include <set>

namespace overt {

namespace {

using AnswersJson = nlohmann::ordered_json;

AnswersJson named(const AnswerOf& of) {
    AnswersJson json{{"task", of.task}, {"answer", of.answer}};
    if (!of.item.empty())
        json["item"] = of.item;
    return json;
}

void add_number(AnswersJson& to, const char* name, std::optional<double> number) {
    if (number)
        to[name] = *number;
}

void add_evidence(AnswersJson& to, const PairedEvidence& evidence) {
    add_number(to, "effect_size", evidence.effect_size.value);
    add_number(to, "bayes_factor", evidence.bayes_factor);
    add_number(to, "equivalence_p", evidence.equivalence_p);
}

void add_estimate(AnswersJson& to, const char* name, const Estimate& of) {
    add_number(to, name, of.value);
    if (of.interval)
        to[std::string(name) + "_interval"] = {of.interval->low, of.interval->high};
}

} // namespace

nlohmann::ordered_json headline_json(const StudyHeadline& headline) {
    return {{"question", headline.question},
            {"design", headline.design},
            {"sample", headline.sample},
            {"result", headline.result}};
}

nlohmann::ordered_json answers_json(const StudyResults& results) {
    const StudyAnswers& answers = results.answers;
    if (answers.given.empty())
        return nullptr;
    const auto missed =
        std::ranges::count_if(answers.given, [](const StudyAnswer& one) { return one.is_missed; });
    AnswersJson json{{"given", static_cast<std::ptrdiff_t>(answers.given.size()) - missed},
                     {"missed", missed},
                     {"bootstrap_samples", 999},
                     {"sources",
                      {"Hautus 1995", "Maloney & Yang 2003", "Knoblauch & Maloney 2008",
                       "Bradley & Terry 1952", "Firth 1993"}}};
    std::map<std::string, std::set<std::pair<std::string, int>>> tracks;
    for (const AnswerTrackRow& row : answers.tracks)
        tracks[row.procedure].insert({row.of.observer, row.track});
    for (const auto& [procedure, own] : tracks)
        json["tracks"][procedure] = own.size();
    for (const AnswerSummaryRow& row : answers.summaries) {
        if (!row.of.observer.empty())
            continue;
        AnswersJson one = named(row.of);
        one["trials"] = row.trials;
        one["missed"] = row.missed;
        add_estimate(one, "correct", row.correct);
        add_number(one, "d_prime", row.d_prime);
        if (!row.design.empty())
            one["design"] = row.design;
        add_number(one, "design_d_prime", row.design_d_prime);
        add_number(one, "median_response_s", row.median_response_s);
        json["answers"].push_back(std::move(one));
    }
    for (const AnswerCurveRow& row : answers.curves) {
        if (!row.of.observer.empty())
            continue;
        AnswersJson one = named(row.of);
        one["factor"] = row.factor;
        one["yes"] = row.yes;
        if (!row.column.empty())
            one["within"] = {{"column", row.column}, {"value", row.level}};
        one["guess"] = row.guess;
        add_estimate(one, "threshold", row.threshold);
        add_number(one, "slope", row.slope);
        add_number(one, "planted_threshold", row.planted_threshold);
        add_number(one, "planted_slope", row.planted_slope);
        json["functions"].push_back(std::move(one));
    }
    for (const AnswerScaleRow& row : answers.scales) {
        if (!row.of.observer.empty())
            continue;
        AnswersJson one = named(row.of);
        one["method"] = row.method;
        one["factor"] = row.factor;
        one["level"] = row.level;
        add_estimate(one, "value", row.value);
        add_number(one, "sigma", row.sigma);
        add_number(one, "planted", row.planted);
        json["scales"].push_back(std::move(one));
    }
    for (const AnswerRatingRow& row : answers.ratings) {
        if (!row.of.observer.empty())
            continue;
        AnswersJson one = named(row.of);
        if (!row.factor.empty()) {
            one["factor"] = row.factor;
            one["level"] = row.level;
        }
        add_estimate(one, "mean", row.mean);
        add_number(one, "planted", row.planted);
        json["ratings"].push_back(std::move(one));
    }
    for (const AnswerMatchLineRow& row : answers.match_lines) {
        if (!row.of.observer.empty())
            continue;
        AnswersJson one = named(row.of);
        one["along"] = row.along;
        if (!row.column.empty()) {
            one["compared"] = row.column;
            one["level"] = row.level;
        }
        add_estimate(one, "slope", row.slope);
        add_estimate(one, "intercept", row.intercept);
        if (row.brunswik.value)
            add_estimate(one, "brunswik", row.brunswik);
        if (row.thouless.value)
            add_estimate(one, "thouless", row.thouless);
        add_number(one, "planted", row.planted);
        json["matches"].push_back(std::move(one));
    }
    for (const AnswerDifferenceRow& row : answers.differences) {
        AnswersJson one = named(row.of);
        one["measure"] = row.measure;
        one["compared"] = row.column;
        one["a"] = row.a;
        one["b"] = row.b;
        add_estimate(one, "difference", row.difference);
        add_number(one, "p", row.p);
        add_number(one, "p_holm", row.p_holm);
        add_evidence(one, row.evidence);
        add_number(one, "planted", row.planted);
        one["observers"] = row.observers;
        json["differences"].push_back(std::move(one));
    }
    for (const GazeChoiceRow& row : answers.gaze_choices) {
        if (!row.of.observer.empty())
            continue;
        AnswersJson one = named(row.of);
        one["measure"] = row.measure;
        if (!row.area.empty())
            one["area"] = row.area;
        if (!row.a.empty()) {
            one["a"] = row.a;
            one["b"] = row.b;
        }
        add_estimate(one, "value", row.value);
        one["chance"] = row.chance;
        add_number(one, "p", row.p);
        add_number(one, "p_holm", row.p_holm);
        add_evidence(one, row.evidence);
        add_number(one, "planted", row.planted);
        json["gaze_and_choice"].push_back(std::move(one));
    }
    return json;
}

} // namespace overt
