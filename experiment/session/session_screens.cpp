#include "experiment/session/session_screens.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/answers/answer_kinds.h"
#include "experiment/answers/answer_sheet.h"
#include "experiment/calibration/own_calibration.h"
#include "experiment/design/answer_forms.h"
#include "experiment/design/trial_plan.h"
#include "experiment/session/observer_form.h"
#include "experiment/session/step_screens.h"

namespace overt::screens {

namespace {

/// A key's name as it stands on a keyboard: "F1", "Y".
std::string key_cap(std::string name) {
    for (char& letter : name)
        letter = static_cast<char>(letter >= 'a' && letter <= 'z' ? letter - 'a' + 'A' : letter);
    return name;
}

/// Words in which {} stands for a number of seconds.
std::string with_seconds(std::string words, double seconds) {
    const std::size_t at = words.find("{}");
    return at == std::string::npos ? words : words.replace(at, 2, fmt::format("{:.0f}", seconds));
}

Screen ended_by_key(const WordSettings& words, std::string text, const std::string& what_it_does) {
    return {.kind = Screen::Kind::text, .text = std::move(text), .keys = {{words.space_bar, what_it_does}}};
}

const std::string& question_of(const Protocol& protocol, int task) {
    return protocol.tasks[static_cast<std::size_t>(task)].question;
}

} // namespace

Screen text(const Protocol& protocol, std::string text) {
    return ended_by_key(protocol.words, std::move(text), protocol.words.go_on);
}

Screen consent(const Protocol& protocol) {
    const ConsentSettings& consent = protocol.consent;
    return {.kind = Screen::Kind::text,
            .text = consent.text,
            .keys = {{key_cap(consent.accept_key), protocol.words.agree},
                     {key_cap(consent.decline_key), protocol.words.decline}}};
}

Screen instructions(const Protocol& protocol, std::size_t page) {
    const std::vector<std::string>& pages = protocol.instructions.pages;
    Screen screen = text(protocol, pages[page]);
    if (page > 0)
        screen.keys.insert(screen.keys.begin(), {"←", protocol.words.back});
    screen.page = static_cast<int>(page) + 1;
    screen.pages = static_cast<int>(pages.size());
    return screen;
}

Screen farewell(const Protocol& protocol) {
    return ended_by_key(protocol.words, protocol.screens.farewell_text, protocol.words.close);
}

Screen question(const Protocol& protocol, int task) { return text(protocol, question_of(protocol, task)); }

Screen response(const Protocol& protocol, int task) {
    const ScreenSettings& screens = protocol.screens;
    return ended_by_key(protocol.words,
                        screens.repeat_question ? question_of(protocol, task) + "\n\n" + screens.response_text
                                                : screens.response_text,
                        protocol.words.answered);
}

Screen answers(const Protocol& protocol, int task, AnswerView view) {
    Screen screen{.kind = Screen::Kind::answers, .text = ""};
    screen.answers = std::move(view);
    const bool is_asked = std::ranges::any_of(screen.answers.items,
                                              [](const AnswerItem& item) { return !item.question.empty(); });
    if (!is_asked || protocol.screens.repeat_question)
        screen.text = question_of(protocol, task);
    return screen;
}

std::vector<TaskScreen> answers_of_tasks(const Protocol& protocol) {
    std::vector<TaskScreen> all;
    for (int task = 0; task < static_cast<int>(protocol.tasks.size()); ++task) {
        Trial trial;
        trial.task = task;
        const TrialPlan plan = plan_trial(protocol, 0, trial, false);
        int place = 0;
        const auto is_on_screen = [&](const PlannedSheet& sheet) {
            const auto number = static_cast<int>(&sheet - plan.sheets.data());
            return std::ranges::any_of(plan.steps, [&](const PlannedStep& step) {
                return step.kind == StepKind::answer && step.sheet == number;
            });
        };
        for (const PlannedSheet& planned : plan.sheets) {
            const std::vector<AnswerForm> forms =
                answer_forms({.protocol = protocol, .trial = trial}, planned.answers, place);
            place += static_cast<int>(forms.size());
            // What is answered while the stimulus is shown, and then only, has no screen of its own.
            if (!is_on_screen(planned))
                continue;
            std::string name = protocol.tasks[static_cast<std::size_t>(task)].id;
            if (plan.sheets.size() > 1)
                name += fmt::format("_{}", &planned - plan.sheets.data() + 1);
            AnswerView view = AnswerSheet(forms, planned.waits_unseen).view(protocol.words.go_on);
            all.push_back({task, std::move(name), answers(protocol, task, std::move(view))});
        }
    }
    return all;
}

double break_asleep_s(const BreakSettings& breaks) {
    return breaks.pace == BreakPace::timed ? breaks.duration_s : breaks.min_s;
}

Screen break_asleep(const Protocol& protocol) {
    const BreakSettings& breaks = protocol.breaks;
    const WordSettings& words = protocol.words;
    return {.kind = Screen::Kind::text,
            .text = breaks.text,
            .keys = {{"", with_seconds(breaks.pace == BreakPace::timed ? words.goes_on_itself : words.rest,
                                       break_asleep_s(breaks))}}};
}

Screen break_awake(const Protocol& protocol) { return text(protocol, protocol.breaks.text); }

Screen pause(const Protocol& protocol) {
    return {.kind = Screen::Kind::text,
            .text = protocol.operators.pause_text,
            .keys = {{key_cap(protocol.operators.pause), protocol.words.go_on}},
            .frame = protocol.words.experimenter};
}

Screen keyboard_lost(const Protocol& protocol) {
    return {.kind = Screen::Kind::text,
            .text = protocol.words.keyboard_lost,
            .frame = protocol.words.experimenter};
}

Screen operator_question(const Protocol& protocol, const std::string& question) {
    const OperatorSettings& keys = protocol.operators;
    return {.kind = Screen::Kind::text,
            .text = question,
            .keys = {{key_cap(keys.yes), protocol.words.yes}, {key_cap(keys.no), protocol.words.no}},
            .frame = protocol.words.experimenter};
}

std::string skip_question(const Protocol& protocol) {
    std::string question = protocol.words.skip;
    const std::vector<std::string>& reasons = protocol.operators.skip_reasons;
    for (std::size_t i = 0; i < reasons.size(); ++i)
        question +=
            fmt::format("{}{}: {}, {}", i == 0 ? "\n\n" : "\n", i + 1, protocol.words.yes, reasons[i]);
    return question;
}

Screen validation(const Protocol& protocol, const ValidationResult& found, const std::string& question) {
    Screen screen = operator_question(protocol, fmt::format("{}\n{:.2f}° ({:.2f}°)", question,
                                                            found.mean_error.value, found.max_error.value));
    screen.kind = found.targets.empty() ? Screen::Kind::text : Screen::Kind::validation;
    screen.validated = found.targets;
    return screen;
}

Screen please_wait(const Protocol& protocol) {
    return {.kind = Screen::Kind::text, .text = protocol.words.please_wait};
}

namespace {

/// What a validation of the protocol's targets may find: gaze so many degrees off, in both eyes, each
/// target's in another direction. `misses_one`: one target was not seen.
ValidationResult example_of_validation(const Protocol& protocol, double error_deg, bool misses_one) {
    const ScreenGeometry screen = screen_geometry_of(protocol);
    ValidationResult found;
    double turn = 0.7;
    for (const ScreenPoint target : validation_targets(protocol.calibration, screen)) {
        for (const Eye eye : {Eye::left, Eye::right}) {
            const double off_px = error_deg * screen.px_per_deg_at_centre();
            const ScreenPoint gaze{target.x_px + off_px * std::cos(turn),
                                   target.y_px + off_px * std::sin(turn)};
            found.targets.push_back({eye, target, gaze, screen.angle_between(gaze, target), {}, {}});
            turn += 2.4;
        }
    }
    if (misses_one)
        found.targets.back().gaze.reset();
    found.sum_up();
    return found;
}

/// Its answers, or one of them, are spoken: then a key ends the screen.
bool is_spoken(const Task& task) {
    return task.answers.empty() || std::ranges::any_of(task.answers, [](const TaskAnswer& answer) {
               return row_of(answer.kind).make == nullptr;
           });
}

} // namespace

namespace {

/// The texts and feedbacks of a task's own steps, of its first stimulus; with a number where it has several.
std::vector<std::pair<std::string, Screen>> words_of_steps(const Protocol& protocol, int task) {
    std::vector<std::pair<std::string, Screen>> all;
    Trial trial;
    trial.task = task;
    const TrialPlan plan = plan_trial(protocol, 0, trial, false);
    for (const StepKind kind : {StepKind::text, StepKind::feedback}) {
        const auto is_one = [&](const PlannedStep& step) { return step.settings && step.kind == kind; };
        const bool has_several = std::ranges::count_if(plan.steps, is_one) > 1;
        int number = 0;
        for (const PlannedStep& step : plan.steps) {
            if (!is_one(step))
                continue;
            const std::string name =
                fmt::format("{}_{}{}", name_of(kind), protocol.tasks[static_cast<std::size_t>(task)].id,
                            has_several ? fmt::format("_{}", ++number) : "");
            StepCircumstances of{.protocol = protocol, .trial = trial};
            if (kind == StepKind::text) {
                all.emplace_back(name, screen_of(step, of));
                continue;
            }
            const StepSettings& words = *step.settings;
            const auto add = [&](const char* which, const std::string& text, bool is_answered,
                                 std::optional<bool> is_correct) {
                of.is_answered = is_answered;
                of.is_correct = is_correct;
                if (!text.empty())
                    all.emplace_back(name + "_" + which, screen_of(step, of));
            };
            add("answered", words.answered, true, std::nullopt);
            add("correct", words.correct, true, true);
            add("wrong", words.wrong, true, false);
            add("missed", words.missed, false, std::nullopt);
        }
    }
    return all;
}

} // namespace

std::vector<std::pair<std::string, Screen>> all_of(const Protocol& protocol) {
    std::vector<std::pair<std::string, Screen>> all;
    const auto add = [&](std::string name, Screen screen) {
        if (screen.kind == Screen::Kind::form || screen.kind == Screen::Kind::target ||
            screen.kind == Screen::Kind::answers || !screen.text.empty())
            all.emplace_back(std::move(name), std::move(screen));
    };
    add("consent", consent(protocol));
    for (const std::string& when : moments_asked(protocol.observer_fields)) {
        const std::vector<ObserverFieldSettings> fields = fields_asked(protocol.observer_fields, when);
        const std::string block = when.substr(std::min(when.size(), form_after_block.size()));
        add(when == form_at_begin ? "form"
            : when == form_at_end ? "form_end"
                                  : "form_after_" + block,
            ObserverForm(fields, {}, protocol.words).screen());
    }
    add("welcome", text(protocol, protocol.screens.welcome_text));
    for (std::size_t page = 0; page < protocol.instructions.pages.size(); ++page)
        add(fmt::format("instructions_{}", page + 1), instructions(protocol, page));
    add("please_wait", please_wait(protocol));
    const CalibrationKeys& calibration = protocol.calibration;
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    add("calibration_target",
        {.kind = Screen::Kind::target,
         .text = "",
         .target_place = calibration_targets(calibration.points, calibration.area, geometry)[1],
         .target_diameter = Degrees{calibration.target_deg}});
    add("validation",
        validation(protocol, example_of_validation(protocol, 0.4 * calibration.mean_limit_deg, false),
                   protocol.words.validation));
    add("validation_poor",
        validation(protocol, example_of_validation(protocol, 1.5 * calibration.max_limit_deg, true),
                   protocol.words.validation_poor));
    add("drift_check_target", {.kind = Screen::Kind::target, .text = ""});
    for (const BlockSettings& block : protocol.blocks)
        add("block_" + block.id, text(protocol, block.instructions));
    for (std::size_t task = 0; task < protocol.tasks.size(); ++task) {
        if (protocol.tasks[task].steps.empty())
            add("question_" + protocol.tasks[task].id, question(protocol, static_cast<int>(task)));
        for (auto& [name, screen] : words_of_steps(protocol, static_cast<int>(task)))
            add(name, std::move(screen));
    }
    bool has_response = false;
    for (std::size_t task = 0; task < protocol.tasks.size(); ++task) {
        if (!is_spoken(protocol.tasks[task]) || (has_response && !protocol.screens.repeat_question))
            continue;
        has_response = true;
        add(protocol.screens.repeat_question ? "response_" + protocol.tasks[task].id : "response",
            response(protocol, static_cast<int>(task)));
    }
    for (TaskScreen& one : answers_of_tasks(protocol))
        add("answers_" + one.name, std::move(one.screen));
    for (std::size_t i = 0; i < protocol.practice.size(); ++i)
        add(fmt::format("feedback_{}", i + 1), text(protocol, protocol.practice[i].feedback));
    if (protocol.breaks.every_trials > 0 || protocol.breaks.between_blocks) {
        add("break", break_asleep(protocol));
        if (protocol.breaks.pace == BreakPace::self)
            add("break_over", break_awake(protocol));
    }
    add("farewell", farewell(protocol));
    add("operator_pause", pause(protocol));
    add("keyboard_lost", keyboard_lost(protocol));
    const WordSettings& words = protocol.words;
    add("operator_recalibrate", operator_question(protocol, words.recalibrate));
    add("operator_not_calibrated", operator_question(protocol, words.not_calibrated));
    add("operator_tracker_lost", operator_question(protocol, words.tracker_lost));
    add("operator_repeat", operator_question(protocol, words.repeat));
    add("operator_reject", operator_question(protocol, words.reject));
    add("operator_skip", operator_question(protocol, skip_question(protocol)));
    add("operator_abort", operator_question(protocol, words.abort));
    add("operator_abort_in_trial", operator_question(protocol, words.abort_in_trial));
    return all;
}

} // namespace overt::screens
