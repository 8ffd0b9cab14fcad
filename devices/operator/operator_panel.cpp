#include "devices/operator/operator_panel.h"

#include <utility>

#include "experiment/ports/event_kinds.h"
#include "experiment/ports/session_log.h"

namespace overt {

namespace {

using PanelKey = ResponsePress::Key;

bool is_asked_about(PanelKey key) noexcept { return key != PanelKey::pause && key != PanelKey::drift_check; }

} // namespace

void OperatorPanel::await(Awaited what, SessionTime since, const Trial* trial) {
    is_asked_ = what == Awaited::decision;
    next_answer_.reset();
    if (is_asked_ && given_ && given_->is_asked_next) {
        next_answer_ = ResponsePress{given_->reason > 0 ? PanelKey::character : PanelKey::yes, since,
                                     static_cast<char32_t>(U'0' + static_cast<char32_t>(given_->reason))};
        given_.reset();
    } else if (what != Awaited::decision && what != Awaited::consent) {
        given_.reset(); // whatever the key led to is over
    }
    answering_->await(what, since, trial);
}

void OperatorPanel::entered(SessionPhase phase, int trial) noexcept {
    phase_ = phase;
    trial_ = trial;
    answering_->entered(phase, trial);
}

void OperatorPanel::acted_on(std::string_view key) noexcept {
    if (given_ && name_of(given_->key) == key)
        given_->is_asked_next = true;
}

void OperatorPanel::reply(std::string_view words) noexcept {
    ViewNews news{.kind = ViewNews::Kind::reply, .trial = trial_, .at = clock_->now()};
    news.set_text(words);
    server_->push(news);
}

std::string_view OperatorPanel::refusal_of(PanelKey key) const noexcept {
    const bool is_of_trials = key == PanelKey::repeat || key == PanelKey::reject || key == PanelKey::skip ||
                              key == PanelKey::drift_check;
    if (is_of_trials && !is_in_trial(phase_))
        return "was not taken: no trial is under way";
    if (is_asked_ && key != PanelKey::abort)
        return "was not taken: the session asks something, answer yes or no first";
    return {};
}

/// What a command is to the session; nothing for one that is no press.
std::optional<ResponsePress> OperatorPanel::take(const OperatorCommand& command) noexcept {
    const SessionTime now = clock_->now();
    const bool is_answer =
        command.kind == OperatorCommand::Kind::yes || command.kind == OperatorCommand::Kind::no;
    if (is_answer && !is_asked_) {
        reply("was not taken: the session asks nothing");
        return std::nullopt;
    }
    if (command.kind == OperatorCommand::Kind::key)
        if (const std::string_view why = refusal_of(command.key); !why.empty()) {
            reply(why);
            return std::nullopt;
        }
    // What is acknowledged is recorded: what would find no room is not taken at all. To end a session, and to
    // answer what it asks, always is.
    const bool is_note = command.kind == OperatorCommand::Kind::note;
    const bool may_wait =
        is_note || (command.kind == OperatorCommand::Kind::key && command.key != PanelKey::abort);
    if (may_wait && taken_count_ >= taken_.size() - (is_note ? kept_for_keys : std::size_t{4})) {
        reply(is_note ? "the note was not taken: too many wait for the trial's end; send it again then"
                      : "was not taken: too many commands wait for the trial's end");
        return std::nullopt;
    }
    if (taken_count_ < taken_.size())
        taken_[taken_count_++] = {command, now, trial_};
    switch (command.kind) {
    case OperatorCommand::Kind::note:
        reply("the note goes into the record");
        return std::nullopt;
    case OperatorCommand::Kind::yes:
        return ResponsePress{PanelKey::yes, now};
    case OperatorCommand::Kind::no:
        return ResponsePress{PanelKey::no, now};
    case OperatorCommand::Kind::key:
        break;
    }
    if (is_asked_about(command.key))
        given_ = Given{command.key, command.reason};
    reply("the command was taken");
    return ResponsePress{command.key, now};
}

std::optional<ResponsePress> OperatorPanel::poll() noexcept {
    if (next_answer_)
        return std::exchange(next_answer_, std::nullopt);
    // A key waits until the session has dealt with the one before; to end the session, and to answer, never.
    OperatorCommand command;
    const auto waits = [this](const OperatorCommand& one) {
        return given_ && one.kind == OperatorCommand::Kind::key && one.key != PanelKey::abort;
    };
    if (held_ && !waits(*held_))
        if (const auto press = take(*std::exchange(held_, std::nullopt)))
            return press;
    while (server_->next_command(command)) {
        if (waits(command)) {
            if (held_)
                reply("was not taken: a command before it still waits");
            else
                held_ = command;
            continue;
        }
        if (const auto press = take(command))
            return press;
    }
    return answering_->poll();
}

void OperatorPanel::write_down(SessionLog& log) {
    for (std::size_t i = 0; i < taken_count_; ++i) {
        const Taken& taken = taken_[i];
        const bool is_note = taken.command.kind == OperatorCommand::Kind::note;
        log.event({taken.at, taken.trial, is_note ? operator_note_event : operator_view_event,
                   is_note ? std::string(taken.command.note()) : words_of(taken.command)});
    }
    taken_count_ = 0;
    answering_->write_down(log);
}

} // namespace overt
