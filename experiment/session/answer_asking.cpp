#include "experiment/session/answer_asking.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "experiment/design/match_levels.h"
#include "experiment/ports/answer_offer.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/session/session_screens.h"

namespace overt {

AnswerAsking::AnswerAsking(SessionState& state, OperatorControl& control, const Schedule& schedule,
                           const ShownProbes& probes)
    : state_(state), control_(control), schedule_(schedule), probes_(probes),
      ranks_(ranks_in_tasks(schedule.trials)) {}

void AnswerAsking::begin_trial(const Trial& trial, const TrialPlan& plan, ObjectTurning& turning,
                               bool is_practice) {
    trial_ = &trial;
    plan_ = &plan;
    turning_ = &turning;
    turned_shows_ = 0;
    sheets_.clear();
    current_ = nullptr;
    is_awaiting_ = has_screen_ = is_drawing_due_ = false;
    opening_told_.reset();
    answers_marked_ = 0;
    const auto index = static_cast<std::size_t>(trial.index);
    const AskedTrial asked{.protocol = state_.protocol,
                           .trial = trial,
                           .seed = schedule_.seed,
                           .observer = schedule_.observer.number,
                           .rank = !is_practice && index < ranks_.size() ? ranks_[index] : trial.index,
                           .is_practice = is_practice};
    int place = 0;
    for (const PlannedSheet& sheet : plan.sheets) {
        const std::vector<AnswerForm> forms = answer_forms(asked, sheet.answers, place);
        place += static_cast<int>(forms.size());
        sheets_.push_back(std::make_unique<AnswerSheet>(forms, sheet.waits_unseen));
    }
}

const AnswerSheet* AnswerAsking::sheet_at(std::size_t number) const noexcept {
    const int sheet = plan_->steps[number].sheet;
    return sheet < 0 ? nullptr : sheets_[static_cast<std::size_t>(sheet)].get();
}

/// Of a step without one, the one that is asked next: what is pressed now comes too early for it.
AnswerSheet& AnswerAsking::sheet_of(std::size_t number) noexcept {
    for (std::size_t i = number; i < plan_->steps.size(); ++i)
        if (plan_->steps[i].sheet >= 0)
            return *sheets_[static_cast<std::size_t>(plan_->steps[i].sheet)];
    return *sheets_.back();
}

void AnswerAsking::go_to(AnswerSheet& sheet) {
    if (current_ != &sheet) {
        current_ = &sheet;
        answers_marked_ = sheet.given_count();
        opening_told_.reset();
        is_awaiting_ = false;
    }
    sheet.begin_step();
}

void AnswerAsking::begin_watched_step(std::size_t number, SessionTime since, bool goes_elsewhere) {
    step_since_ = since;
    if (!asks() && !turning_->is_active())
        return;
    if (asks())
        go_to(sheet_of(number));
    put_beside(number);
    if (goes_elsewhere) {
        is_awaiting_ = false;
        return;
    }
    // Where a gauge stands is known once its stimulus is shown.
    const bool shows_gauge = current_ && current_->gauge() && plan_->steps[number].kind == StepKind::show;
    if (!is_awaiting_ || shows_gauge) {
        offer();
        state_.ports.panel.await_answer(since, trial_);
        is_awaiting_ = true;
        tell_opening();
    }
    offer_turning(number, since);
}

/// To those who do not see what can be turned in this step.
void AnswerAsking::offer_turning(std::size_t number, SessionTime since) {
    if (!turning_->is_active())
        return;
    const double lasts_s = plan_->steps[number].drawn_s.value_or(state_.protocol.screens.response_max_s);
    for (const TurningOffer& offer : turning_->offers(turned_shows_, since, lasts_s))
        state_.ports.panel.offer_turning(offer);
    ++turned_shows_;
}

std::optional<AnswerSheet::SetLevel> AnswerAsking::level_of(int place) const noexcept {
    for (const std::unique_ptr<AnswerSheet>& sheet : sheets_)
        if (const std::optional<AnswerSheet::SetLevel> level = sheet->level_of(place))
            return level;
    return std::nullopt;
}

/// Tells the panel what can be answered; of gauges, with the surface where they stand.
void AnswerAsking::offer() {
    std::vector<AnswerOffer> offers = current_ ? current_->offers() : std::vector<AnswerOffer>();
    for (AnswerOffer& of : offers)
        if (const Answering* const gauge = of.attitude ? current_->gauge() : nullptr)
            of.true_attitude = probes_.truth_at(gauge->form().probe);
    state_.ports.panel.offer(offers);
}

void AnswerAsking::begin_standing_step(std::size_t number, SessionTime since) {
    const auto asks_an_answer = [](const PlannedStep& step) { return step.sheet >= 0; };
    const auto here = plan_->steps.begin() + static_cast<std::ptrdiff_t>(number);
    if (!asks() || is_awaiting_ || std::any_of(here, plan_->steps.end(), asks_an_answer) ||
        std::none_of(plan_->steps.begin(), here, asks_an_answer))
        return;
    go_to(*sheets_.back());
    state_.ports.panel.offer({});
    state_.ports.panel.await_answer(since, trial_);
    is_awaiting_ = true;
}

/// Choices that are slots are clicked on themselves, where the step shows them.
void AnswerAsking::find_slot_targets(const PlannedStep& step) {
    const Task& task = state_.protocol.tasks[static_cast<std::size_t>(trial_->task)];
    const std::vector<int>& answers = plan_->sheets[static_cast<std::size_t>(step.sheet)].answers;
    for (std::size_t item = 0; item < answers.size(); ++item) {
        const TaskAnswer& answer = task.answers[static_cast<std::size_t>(answers[item])];
        if (!answer.items.empty())
            return; // what comes behind stands elsewhere on the screen
        for (std::size_t option = 0; option < answer.choices.size(); ++option) {
            if (answer.with == AnsweredWith::keys)
                continue;
            for (const int place : step.places) {
                const Slot& slot =
                    state_.protocol
                        .slots[static_cast<std::size_t>(trial_->shown(static_cast<std::size_t>(place)).slot)];
                if (slot.id != answer.choices[option])
                    continue;
                const ScreenGeometry screen = slot_geometry(state_.protocol, slot);
                const glm::dvec2 middle(screen.centre().x_px, screen.centre().y_px);
                const glm::dvec2 first = glm::dvec2(screen.image_origin_px) - middle;
                slot_targets_.push_back(
                    {first,
                     first + glm::dvec2(screen.image_px),
                     {.item = static_cast<int>(item), .option = static_cast<int>(option)}});
            }
        }
    }
}

/// What was drawn there, or the slot that is.
AnswerPlace AnswerAsking::place_of(const ObserverInput& input) const noexcept {
    const bool points = input.kind == ObserverInput::Kind::pointer_down ||
                        input.kind == ObserverInput::Kind::pointer_moved ||
                        input.kind == ObserverInput::Kind::pointer_up;
    if (!points || !has_screen_)
        return {};
    const AnswerPlace drawn = state_.ports.presenter.place_in_answers(input.right_px, input.down_px);
    if (drawn.item >= 0 || drawn.is_accept)
        return drawn;
    for (const SlotTarget& target : slot_targets_)
        if (input.right_px >= target.first_px.x && input.right_px < target.end_px.x &&
            input.down_px >= target.first_px.y && input.down_px < target.end_px.y)
            return target.place;
    return drawn;
}

/// What the step waits for stands with its stimulus, where the protocol has a place for it.
void AnswerAsking::put_beside(std::size_t number) {
    const PlannedStep& step = plan_->steps[number];
    take_away();
    const bool waits =
        step.kind == StepKind::show && step.ends_by_answer() && step.sheet >= 0 && !current_->is_complete();
    if (!waits) {
        if (!turning_->shows_pointer())
            return;
        AnswerView pointer;
        pointer.shows_pointer = true;
        state_.ports.presenter.put_beside_stimuli(&pointer);
        stands_beside_ = true;
        return;
    }
    const Task& task = state_.protocol.tasks[static_cast<std::size_t>(trial_->task)];
    const PlannedSheet& sheet = plan_->sheets[static_cast<std::size_t>(step.sheet)];
    std::optional<double> up_deg;
    for (const int answer : sheet.answers)
        if (!up_deg)
            up_deg = task.answers[static_cast<std::size_t>(answer)].beside_up_deg;
    const bool is_turned = turning_->shows_pointer();
    find_slot_targets(step);
    if (!up_deg && !current_->points() && !is_turned && slot_targets_.empty())
        return;
    AnswerView view = current_->view(state_.protocol.words.go_on);
    view.up_deg = up_deg;
    view.shows_pointer = view.shows_pointer || is_turned;
    if (!up_deg) { // the mouse's pointer alone
        view.items.clear();
        view.accept.clear();
    }
    state_.ports.presenter.put_beside_stimuli(&view);
    stands_beside_ = has_screen_ = true;
}

void AnswerAsking::take_away() {
    has_screen_ = false;
    slot_targets_.clear();
    if (std::exchange(stands_beside_, false))
        state_.ports.presenter.put_beside_stimuli(nullptr);
}

void AnswerAsking::tell_opening() noexcept {
    if (!current_ || !is_awaiting_)
        return;
    const std::optional<SessionTime> opened = current_->opened_at();
    if (!opened || opened == opening_told_)
        return;
    opening_told_ = opened;
    state_.ports.panel.window_opened(*opened);
}

void AnswerAsking::stimulus_lit(std::size_t number, SessionTime onset) noexcept {
    for (std::size_t i = 0; i < sheets_.size(); ++i)
        if (plan_->sheets[i].stimulus_step == static_cast<int>(number))
            sheets_[i]->stimulus_lit(onset);
    tell_opening();
}

void AnswerAsking::stimulus_gone(SessionTime offset) noexcept {
    for (const std::unique_ptr<AnswerSheet>& sheet : sheets_)
        sheet->stimulus_gone(offset);
    tell_opening();
}

/// In the order of time, whatever device they come from.
void AnswerAsking::look() noexcept {
    if (!is_awaiting_)
        return;
    std::size_t count = 0;
    while (count < batch_.size()) {
        const std::optional<ObserverInput> input = state_.ports.panel.next_input();
        if (!input)
            break;
        std::size_t at = count++;
        for (; at > 0 && batch_[at - 1].at > input->at; --at)
            batch_[at] = batch_[at - 1];
        batch_[at] = *input;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const ObserverInput& input = batch_[i];
        if (turning_->take(input) || !current_)
            continue;
        is_drawing_due_ = current_->take(input, place_of(input)) || is_drawing_due_;
        note_answer();
    }
    tell_opening();
}

/// Other devices are told of an answer when it is given.
void AnswerAsking::note_answer() noexcept {
    const int given = current_->given_count();
    if (given > answers_marked_)
        state_.markers.mark(MarkedEvent::response, current_->given_last_at(), "RESPONSE");
    answers_marked_ = given;
}

bool AnswerAsking::has_ended(std::size_t number) const noexcept {
    const AnswerSheet* const sheet = sheet_at(number);
    if (!sheet || !plan_->steps[number].ends_by_answer())
        return false;
    const std::optional<SessionTime> at = sheet->ends_stimulus_at();
    return at && (!step_since_ || *at >= *step_since_);
}

bool AnswerAsking::is_needless(std::size_t number) const noexcept {
    const AnswerSheet* const sheet = sheet_at(number);
    return sheet && sheet->is_over_at(state_.now()).has_value();
}

Screen AnswerAsking::screen() const {
    return screens::answers(state_.protocol, trial_->task, current_->view(state_.protocol.words.go_on));
}

OperatorControl::Press AnswerAsking::ask(std::size_t number, const std::optional<Trial>& next,
                                         SessionTime& onset) {
    const PlannedStep& step = plan_->steps[number];
    SessionPorts& ports = state_.ports;
    if (state_.phase() != SessionPhase::response_screen)
        state_.enter(SessionPhase::response_screen, state_.trial());
    go_to(sheet_of(number));
    take_away();
    int page = current_->page();
    onset = state_.show(screen());
    has_screen_ = true;
    is_drawing_due_ = false;
    current_->screen_lit(onset);
    if (next)
        ports.presenter.expect_slots(loaded_for(state_.protocol, *next));
    SessionTime looked = onset;
    Waiting waiting{.screen = screen(),
                    .onset = onset,
                    .max_s = step.drawn_s.value_or(state_.protocol.screens.response_max_s),
                    .takes_keys = false};
    waiting.await = [&](SessionTime since) {
        // After a pause of the operator's: the window was closed for as long.
        current_->pause(since - std::max(looked, onset));
        current_->begin_step();
        if (!is_awaiting_ || since != onset) {
            offer();
            ports.panel.await_answer(since, trial_);
            is_awaiting_ = true;
            opening_told_.reset();
        }
        is_drawing_due_ = since != onset;
        tell_opening();
    };
    waiting.meanwhile = [&] {
        looked = state_.now();
        look();
        if (!is_drawing_due_ || current_->is_complete())
            return;
        is_drawing_due_ = false;
        const SessionTime lit = state_.show(screen());
        current_->screen_lit(lit);
        if (current_->page() != page) {
            page = current_->page();
            current_->begin_step();
            offer();
            opening_told_.reset();
        }
        tell_opening();
    };
    waiting.is_over = [&] { return current_->is_over_at(state_.now()); };
    const OperatorControl::Press press = control_.wait(waiting);
    look();
    current_->close(state_.now());
    has_screen_ = false;
    is_awaiting_ = false;
    const bool has_all = current_->is_complete() || current_->is_given();
    const bool is_time_up =
        press.how == OperatorControl::How::timed_out || press.how == OperatorControl::How::next;
    if (is_time_up && !has_all) {
        state_.log().event({press.at, state_.trial(), response_timed_out_event, ""});
        return {OperatorControl::How::timed_out, press.at};
    }
    return press;
}

bool AnswerAsking::is_answered() const noexcept {
    return asks() && std::ranges::all_of(sheets_, [](const auto& sheet) { return sheet->is_given(); });
}

std::optional<bool> AnswerAsking::is_correct() const {
    TrialOutcome so_far;
    for (const std::unique_ptr<AnswerSheet>& sheet : sheets_)
        sheet->add_to(so_far.given, so_far.inputs);
    return correctness_of(so_far.given);
}

void AnswerAsking::finish(TrialOutcome& outcome) {
    std::optional<SessionTime> last;
    take_away();
    for (const std::unique_ptr<AnswerSheet>& sheet : sheets_) {
        sheet->close(state_.now());
        sheet->add_to(outcome.given, outcome.inputs);
        if (sheet->lost_inputs() > 0)
            state_.note(answer_recording_event,
                        fmt::format("{} inputs in one trial found no room", sheet->lost_inputs()));
    }
    turning_->add_to(outcome.inputs);
    if (turning_->lost_inputs() > 0)
        state_.note(answer_recording_event,
                    fmt::format("{} inputs that turned an object found no room", turning_->lost_inputs()));
    for (const GivenAnswer& given : outcome.given) {
        if (given.is_missed)
            continue;
        outcome.answer += (outcome.answer.empty() ? "" : "; ") + given.value;
        if (!last || *given.answered_at > *last) {
            last = given.answered_at;
            outcome.responded_uncertainty = given.uncertainty;
        }
    }
    if (last)
        outcome.responded_at = *last;
    is_awaiting_ = false;
}

} // namespace overt
