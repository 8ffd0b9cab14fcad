#include "render/window/window_response_panel.h"

#include <algorithm>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/base/utf8_text.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/ports/session_log.h"
#include "render/window/window_keys.h"

namespace overt {

namespace {
using ResponseKey = ResponsePress::Key;
using SetupKind = SetupKey::Kind;
template <class Meaning> using KeyMeaning = std::pair<WindowKey, Meaning>;

constexpr KeyMeaning<ResponseKey> when_reading[] = {
    {WindowKey::space, ResponseKey::next},     {WindowKey::enter, ResponseKey::next},
    {WindowKey::character, ResponseKey::next}, // response boxes type digits
    {WindowKey::backspace, ResponseKey::back}, {WindowKey::left, ResponseKey::left},
    {WindowKey::right, ResponseKey::right}};
constexpr KeyMeaning<ResponseKey> when_filling_in[] = {{WindowKey::character, ResponseKey::character},
                                                       {WindowKey::backspace, ResponseKey::erase},
                                                       {WindowKey::left, ResponseKey::left},
                                                       {WindowKey::right, ResponseKey::right},
                                                       {WindowKey::up, ResponseKey::up},
                                                       {WindowKey::back_tab, ResponseKey::up},
                                                       {WindowKey::down, ResponseKey::down},
                                                       {WindowKey::tab, ResponseKey::down},
                                                       {WindowKey::enter, ResponseKey::next}};
constexpr KeyMeaning<SetupKind> in_setup[] = {
    {WindowKey::space, SetupKind::space},     {WindowKey::enter, SetupKind::enter},
    {WindowKey::escape, SetupKind::escape},   {WindowKey::backspace, SetupKind::backspace},
    {WindowKey::tab, SetupKind::tab},         {WindowKey::back_tab, SetupKind::tab},
    {WindowKey::up, SetupKind::up},           {WindowKey::down, SetupKind::down},
    {WindowKey::left, SetupKind::left},       {WindowKey::right, SetupKind::right},
    {WindowKey::page_up, SetupKind::page_up}, {WindowKey::page_down, SetupKind::page_down}};

template <class Meaning>
std::optional<Meaning> meaning_in(std::span<const KeyMeaning<Meaning>> table, WindowKey key) noexcept {
    const auto found = std::ranges::find(table, key, &KeyMeaning<Meaning>::first);
    return found == table.end() ? std::nullopt : std::optional(found->second);
}

} // namespace

bool NamedKey::is(const WindowKeyPress& press) const noexcept {
    if (press.is_repeated || press.key != key)
        return false;
    if (key != WindowKey::character)
        return true;
    const char32_t lower =
        press.character >= U'A' && press.character <= U'Z' ? press.character - U'A' + U'a' : press.character;
    return lower == character;
}

NamedKey key_called(const std::string& name) {
    if (name == "escape")
        return {WindowKey::escape};
    if (name == "pause")
        return {WindowKey::pause};
    if (name.size() == 1)
        return {WindowKey::character, static_cast<char32_t>(name[0])};
    return {static_cast<WindowKey>(static_cast<int>(WindowKey::f1) + std::stoi(name.substr(1)) - 1)};
}

std::optional<SetupKey> setup_key_of(const WindowKeyPress& press) noexcept {
    using Kind = SetupKey::Kind;
    if (press.key >= WindowKey::f1 && press.key <= WindowKey::f12)
        return SetupKey{Kind::function, static_cast<char32_t>(1 + static_cast<int>(press.key) -
                                                              static_cast<int>(WindowKey::f1))};
    // The space bar was a key already.
    if (press.key == WindowKey::character)
        return press.character == U' ' ? std::nullopt
                                       : std::optional(SetupKey{Kind::character, press.character});
    const std::optional<Kind> kind = meaning_in<Kind>(in_setup, press.key);
    return kind ? std::optional(SetupKey{*kind}) : std::nullopt;
}

WindowResponsePanel::WindowResponsePanel(WindowContext& window, const Clock& clock,
                                         const OperatorSettings& operators, const ConsentSettings& consent,
                                         ResponsePanel* answering)
    : window_(&window), clock_(&clock),
      answering_(answering), operators_{{{key_called(operators.pause), ResponseKey::pause},
                                         {key_called(operators.recalibrate), ResponseKey::recalibrate},
                                         {key_called(operators.repeat), ResponseKey::repeat},
                                         {key_called(operators.reject), ResponseKey::reject},
                                         {key_called(operators.skip), ResponseKey::skip},
                                         {key_called(operators.abort), ResponseKey::abort}}},
      yes_(key_called(operators.yes)), no_(key_called(operators.no)), accept_(key_called(consent.accept_key)),
      decline_(key_called(consent.decline_key)), answers_(operators.keyboard_answers),
      looked_before_(clock.now()), looked_(looked_before_) {}

std::optional<ResponsePress> WindowResponsePanel::meaning_of(const WindowKeyPress& press) const noexcept {
    // GLFW's events carry no times of their own: the key went down since the keys were looked at before.
    const SessionTime now = looked_;
    const SessionDuration uncertainty = looked_ - looked_before_;
    const bool is_character = press.key == WindowKey::character;
    const bool is_held = press.is_repeated;
    // Where one writes or decides by letters, they are no keys of the operator.
    if (!is_character || awaited_ == Awaited::key)
        for (const auto& [key, meaning] : operators_)
            if (key.is(press))
                return ResponsePress{meaning, now, 0, uncertainty};
    const auto meant = [&](std::optional<ResponseKey> key) {
        return key ? std::optional(ResponsePress{*key, now, press.character, uncertainty}) : std::nullopt;
    };
    // Where the observer has a box, what is the observer's to press is pressed there.
    if (!answers_ && (awaited_ == Awaited::key || awaited_ == Awaited::consent))
        return std::nullopt;
    switch (awaited_) {
    case Awaited::response:
    case Awaited::key: // the space bar was a key already; a key that is held from before answers nothing
        return is_held || (is_character && press.character == U' ')
                   ? std::nullopt
                   : meant(meaning_in<ResponseKey>(when_reading, press.key));
    case Awaited::consent:
    case Awaited::decision: {
        const bool is_consent = awaited_ == Awaited::consent;
        if ((is_consent ? accept_ : yes_).is(press))
            return meant(ResponseKey::yes);
        if ((is_consent ? decline_ : no_).is(press))
            return meant(ResponseKey::no);
        return is_character && !is_consent ? meant(ResponseKey::character) : std::nullopt;
    }
    case Awaited::setup:  // keys are asked for by next_setup_key()
    case Awaited::answer: // by next_input()
        return std::nullopt;
    case Awaited::entry:
        return is_held && press.key == WindowKey::enter
                   ? std::nullopt
                   : meant(meaning_in<ResponseKey>(when_filling_in, press.key));
    }
    return std::nullopt;
}

void WindowResponsePanel::look() noexcept {
    window_->poll_events();
    looked_before_ = looked_;
    looked_ = clock_->now();
    if (window_->has_lost_focus() == is_focus_lost_ || focus_change_count_ == focus_changes_.size())
        return;
    is_focus_lost_ = !is_focus_lost_;
    focus_changes_[focus_change_count_++] = {looked_, is_focus_lost_};
}

namespace {
/// Where another device answers, the keyboard still writes words and numbers.
bool edits(int glfw_key) noexcept {
    constexpr std::string_view editing[] = {"enter",  "keypad enter", "tab", "backspace",
                                            "delete", "home",         "end"};
    const ShortName name = key_name_of(glfw_key, 0);
    return std::ranges::find(editing, name.view()) != std::end(editing);
}
} // namespace

bool WindowResponsePanel::is_operators_key(int glfw_key) const noexcept {
    const WindowKeyPress press{window_key_of(glfw_key, 0)};
    return std::ranges::any_of(operators_, [&](const auto& one) { return one.first.is(press); });
}

std::optional<ObserverInput> WindowResponsePanel::next_input() noexcept {
    using Kind = ObserverInput::Kind;
    for (WindowInput told; awaited_ == Awaited::answer && window_->next_input(told);) {
        const bool is_key = told.kind == Kind::key_down || told.kind == Kind::key_up;
        has_key_gone_down_ = has_key_gone_down_ || told.kind == Kind::key_down;
        // A key that is held since before writes on, but not here.
        if (told.kind == Kind::text && told.is_repeated && !has_key_gone_down_)
            continue;
        if (is_key && (is_operators_key(told.glfw_key) || !(answers_ || edits(told.glfw_key))))
            continue;
        const bool is_mouse = told.kind == Kind::pointer_moved || told.kind == Kind::pointer_down ||
                              told.kind == Kind::pointer_up || told.kind == Kind::wheel;
        ObserverInput input{.kind = told.kind, .at = looked_, .uncertainty = looked_ - looked_before_};
        input.device = ShortName(is_mouse ? mouse_device : keyboard_device);
        if (is_key)
            input.key = key_name_of(told.glfw_key, told.code);
        input.character = told.character;
        const glm::dvec2 place = place_ ? place_(told.from_middle_px) : told.from_middle_px;
        input.right_px = place.x;
        input.down_px = place.y;
        input.button = told.button;
        input.steps = told.steps;
        return input;
    }
    return answering_ ? answering_->next_input() : std::nullopt;
}

void WindowResponsePanel::write_down(SessionLog& log) {
    for (std::size_t i = 0; i < focus_change_count_; ++i)
        log.event({focus_changes_[i].at, -1, keyboard_event,
                   focus_changes_[i].is_lost ? "went to another window: keys did not reach the session"
                                             : "came back to the session's window"});
    focus_change_count_ = 0;
    write_presses(log);
    if (answering_)
        answering_->write_down(log);
}

void WindowResponsePanel::write_presses(SessionLog& log) {
    if (noted_count_ == 0)
        return;
    std::vector<RecordedKeyPress> presses;
    for (std::size_t i = 0; i < noted_count_; ++i) {
        const Noted& noted = noted_[i];
        RecordedKeyPress press{.at = noted.at,
                               .uncertainty = noted.uncertainty,
                               .trial = noted.trial,
                               .device = std::string(keyboard_device),
                               .name = key_name(noted.press),
                               .code = noted.press.code,
                               .modifiers = modifier_names(noted.press),
                               .screen = noted.screen};
        if (noted.press.character > U' ')
            append_utf8(press.text, noted.press.character);
        if (noted.meaning == ResponseKey::next)
            press.meaning = goes_on_at(noted.screen) ? "next" : "";
        else if (noted.meaning)
            press.meaning = name_of(*noted.meaning);
        presses.push_back(std::move(press));
    }
    noted_count_ = 0;
    is_last_noted_ = false;
    log.key_presses(presses);
}

std::vector<std::string> WindowResponsePanel::closing_warnings() const {
    std::vector<std::string> warnings;
    if (answering_)
        warnings = answering_->closing_warnings();
    if (unnoted_ > 0)
        warnings.push_back(fmt::format("keyboard: {} could not be recorded: too many in one presentation",
                                       counted(unnoted_, "key press", "key presses")));
    return warnings;
}

bool WindowResponsePanel::next_press(WindowKeyPress& press) noexcept {
    if (!window_->next_key_press(press))
        return false;
    // What a key wrote comes after it, and is noted with it.
    if (press.key == WindowKey::character) {
        if (is_last_noted_ && !press.is_repeated && noted_[noted_count_ - 1].press.character == 0)
            noted_[noted_count_ - 1].press.character = press.character;
        return true;
    }
    is_last_noted_ = false;
    const std::optional<SessionPhase> screen = pressed_on_.screen();
    if (press.is_repeated || !screen)
        return true;
    if (noted_count_ == noted_.size()) {
        ++unnoted_;
        return true;
    }
    noted_[noted_count_++] = {press, looked_, looked_ - looked_before_, *screen, pressed_on_.trial(), {}};
    is_last_noted_ = true;
    return true;
}

std::optional<ResponsePress> WindowResponsePanel::next_meant() noexcept {
    WindowKeyPress press{};
    while (next_press(press)) {
        const std::optional<ResponsePress> meant = meaning_of(press);
        if (!meant)
            continue;
        if (is_last_noted_ && (meant->key == ResponseKey::next || is_operators(meant->key)))
            noted_[noted_count_ - 1].meaning = meant->key;
        return meant;
    }
    return std::nullopt;
}

void WindowResponsePanel::await(Awaited what, SessionTime since, const Trial* trial) {
    look();
    // The operator's stay: they may have been pressed while something was prepared.
    while (const std::optional<ResponsePress> meant = next_meant()) {
        if (is_operators(meant->key) && kept_count_ < kept_.size())
            kept_[kept_count_++] = *meant;
        else if (is_last_noted_)
            noted_[noted_count_ - 1].meaning.reset(); // it came too early to mean anything
    }
    for (WindowInput early; window_->next_input(early);) {
    }
    pressed_on_.waits_for(what);
    awaited_ = what == Awaited::response ? Awaited::key : what;
    has_key_gone_down_ = false;
    if (answering_)
        answering_->await(what, since, trial);
}

std::optional<SetupKey> WindowResponsePanel::next_setup_key() {
    look();
    WindowKeyPress press{};
    while (next_press(press))
        if (const std::optional<SetupKey> key = setup_key_of(press))
            return key;
    return answering_ ? answering_->next_setup_key() : std::nullopt;
}

std::optional<ResponsePress> WindowResponsePanel::poll() noexcept {
    if (kept_count_ > 0) {
        const ResponsePress press = kept_[0];
        std::copy(kept_.begin() + 1, kept_.begin() + static_cast<std::ptrdiff_t>(kept_count_), kept_.begin());
        --kept_count_;
        return press;
    }
    look();
    if (const std::optional<ResponsePress> meant = next_meant())
        return meant;
    return answering_ ? answering_->poll() : std::nullopt;
}

} // namespace overt
