#include "experiment/study/answers/answer_designs.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace overt {

namespace {

/// The stimulus in a slot; null: nothing is shown there.
const AnsweredStimulus* shown_in(const StudyAnswer& answer, const std::string& slot) {
    const auto found = std::ranges::find(answer.shown, slot, &AnsweredStimulus::slot);
    return found != answer.shown.end() ? &*found : nullptr;
}

AnswerList judged_answers(const AnswerList& answers) {
    AnswerList judged;
    for (const StudyAnswer* one : answers)
        if (!one->is_missed && !one->correct.empty())
            judged.push_back(one);
    return judged;
}

std::set<std::string> right_answers(const AnswerList& judged) {
    std::set<std::string> right;
    for (const StudyAnswer* one : judged)
        right.insert(one->correct);
    return right;
}

/// Alike in a factor in which another is not.
bool is_alike_unlike(const AnsweredStimulus& one, const AnsweredStimulus& other,
                     const AnsweredStimulus& third) {
    for (std::size_t i = 0; i < one.levels.size() && i < other.levels.size() && i < third.levels.size(); ++i)
        if (one.levels[i] == other.levels[i] && one.levels[i] != third.levels[i])
            return true;
    return false;
}

std::optional<AnswerDesign> same_different_design(const AnswerList& judged,
                                                  const std::set<std::string>& right) {
    std::set<std::string> of_alike, of_unlike;
    for (const StudyAnswer* one : judged) {
        if (one->shown.size() != 2 || shown_in(*one, one->correct))
            return std::nullopt;
        (one->shown[0].levels == one->shown[1].levels ? of_alike : of_unlike).insert(one->correct);
    }
    if (right.size() != 2 || of_alike.size() != 1 || of_unlike.size() != 1 || of_alike == of_unlike)
        return std::nullopt;
    return AnswerDesign{AnswerDesign::Kind::same_different, 2, *of_unlike.begin()};
}

std::optional<AnswerDesign> slot_design(const AnswerList& judged, const std::set<std::string>& right) {
    const std::size_t slots = judged.front()->shown.size();
    for (const StudyAnswer* one : judged)
        if (one->shown.size() != slots || !shown_in(*one, one->correct))
            return std::nullopt;
    if (slots == 3 && right.size() == 2) {
        for (const StudyAnswer* one : judged) {
            const AnsweredStimulus *sample = nullptr, *other = nullptr;
            for (const AnsweredStimulus& shown : one->shown)
                (right.contains(shown.slot) ? other : sample) = shown.slot == one->correct ? other : &shown;
            if (!sample || !other || !is_alike_unlike(*shown_in(*one, one->correct), *sample, *other))
                return std::nullopt;
        }
        return AnswerDesign{AnswerDesign::Kind::abx, 3, {}};
    }
    if (slots < 3 || right.size() != slots)
        return std::nullopt;
    using Levels = std::vector<std::pair<std::string, std::string>>;
    std::set<Levels> odd, common;
    bool has_one_odd = slots == 3;
    for (const StudyAnswer* one : judged) {
        Levels others;
        for (const AnsweredStimulus& shown : one->shown) {
            if (shown.slot == one->correct) {
                odd.insert(shown.levels);
                continue;
            }
            has_one_odd = has_one_odd && (others.empty() || others == shown.levels);
            others = shown.levels;
            common.insert(shown.levels);
        }
    }
    const bool changes_sides =
        std::ranges::any_of(odd, [&](const Levels& levels) { return common.contains(levels); });
    return has_one_odd && changes_sides
               ? AnswerDesign{AnswerDesign::Kind::oddity, 3, {}}
               : AnswerDesign{AnswerDesign::Kind::alternatives, static_cast<int>(slots), {}};
}

} // namespace

std::string AnswerDesign::name() const {
    switch (kind) {
    case Kind::same_different:
        return "same-different, differencing";
    case Kind::abx:
        return "ABX, differencing";
    case Kind::oddity:
        return "oddity of three";
    case Kind::alternatives:
        break;
    }
    return fmt::format("{} alternatives", slots);
}

std::optional<SensitivityEstimate> d_prime_of(const AnswerList& answers) {
    const AnswerList judged = judged_answers(answers);
    const std::set<std::string> right = right_answers(judged);
    if (right.size() != 2)
        return std::nullopt;
    const std::string& signal = *right.begin();
    DetectionCounts counts;
    std::set<std::string> slots;
    for (const StudyAnswer* one : judged) {
        for (const AnsweredStimulus& shown : one->shown)
            slots.insert(shown.slot);
        const bool says_signal = one->value == signal;
        double& count = one->correct == signal
                            ? (says_signal ? counts.hits : counts.misses)
                            : (says_signal ? counts.false_alarms : counts.correct_rejections);
        count += 1.0;
    }
    if (counts.hits + counts.misses < 1.0 || counts.false_alarms + counts.correct_rejections < 1.0)
        return std::nullopt;
    const bool is_of_slots = std::ranges::includes(slots, right);
    const DetectionEstimate found = is_of_slots ? two_alternatives(counts, ShareCorrection::log_linear)
                                                : yes_no(counts, ShareCorrection::log_linear);
    return SensitivityEstimate{found.d_prime, found.se, found.criterion};
}

std::optional<AnswerDesign> answer_design(const AnswerList& answers) {
    const AnswerList judged = judged_answers(answers);
    if (judged.empty())
        return std::nullopt;
    const std::set<std::string> right = right_answers(judged);
    if (const auto design = same_different_design(judged, right))
        return design;
    return slot_design(judged, right);
}

std::optional<SensitivityEstimate> d_prime_by(const AnswerDesign& design, const AnswerList& answers) {
    const AnswerList judged = judged_answers(answers);
    if (design.kind == AnswerDesign::Kind::same_different) {
        double hits = 0.0, unlike = 0.0, false_alarms = 0.0, alike = 0.0;
        for (const StudyAnswer* one : judged) {
            const bool says = one->value == design.different;
            (one->correct == design.different ? unlike : alike) += 1.0;
            (one->correct == design.different ? hits : false_alarms) += says ? 1.0 : 0.0;
        }
        if (unlike < 1.0 || alike < 1.0)
            return std::nullopt;
        const auto found =
            d_prime_same_different((hits + 0.5) / (unlike + 1.0), (false_alarms + 0.5) / (alike + 1.0));
        return found ? std::optional(SensitivityEstimate{*found, {}, {}}) : std::nullopt;
    }
    double right = 0.0;
    for (const StudyAnswer* one : judged)
        right += one->value == one->correct ? 1.0 : 0.0;
    if (judged.empty())
        return std::nullopt;
    const DetectionDesign kind = design.kind == AnswerDesign::Kind::abx ? DetectionDesign::abx_differencing
                                 : design.kind == AnswerDesign::Kind::oddity ? DetectionDesign::oddity
                                                                             : DetectionDesign::alternatives;
    const auto found = estimate_d_prime(kind, right, static_cast<double>(judged.size()),
                                        ShareCorrection::log_linear, design.slots);
    return found ? std::optional(SensitivityEstimate{found->d_prime, found->se, {}}) : std::nullopt;
}

} // namespace overt
