#include "app/watch/window/watch_panels.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "experiment/ports/session_phase.h"
#include "experiment/surface/colour_scale.h"

namespace overt {

namespace {

constexpr float left_share = 0.5f, display_share = 0.5f;
const ImVec4 fine{0.75f, 0.85f, 0.75f, 1.0f}, poor{1.0f, 0.55f, 0.35f, 1.0f}, quiet{0.6f, 0.6f, 0.6f, 1.0f};

void row(const char* label, const std::string& value, bool is_poor = false) {
    ImGui::TextColored(quiet, "%s", label);
    ImGui::SameLine(130.0f);
    ImGui::PushStyleColor(ImGuiCol_Text, is_poor ? poor : fine);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(value.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

std::string share(std::int64_t samples, std::int64_t lost) {
    const std::optional<double> found = lost_share(samples, lost);
    return found ? fmt::format("{:.1f} %", 100.0 * *found) : std::string("-");
}

std::string degrees(const std::optional<double>& value) {
    return value ? fmt::format("{:.2f} deg", *value) : std::string("-");
}

// NOLINTNEXTLINE(performance-no-int-to-ptr): Dear ImGui has names of textures as pointers
void* texture_of(GLuint name) { return reinterpret_cast<void*>(static_cast<std::uintptr_t>(name)); }

/// The colours from nothing to the most, with words at both ends.
void draw_scale(ImDrawList& draws, ImVec2 at, float width, const std::string& most) {
    constexpr float height = 10.0f;
    const ColourTable& table = colour_table(ColourMap::viridis);
    for (int i = 0; i < 64; ++i) {
        const auto& [red, green, blue] = table[static_cast<std::size_t>(i * 255 / 63)];
        draws.AddRectFilled({at.x + width * static_cast<float>(i) / 64.0f, at.y},
                            {at.x + width * static_cast<float>(i + 1) / 64.0f, at.y + height},
                            IM_COL32(red, green, blue, 255));
    }
    const ImU32 grey = IM_COL32(200, 200, 200, 255);
    draws.AddText({at.x, at.y + height + 1.0f}, grey, "none");
    draws.AddText({at.x + width - ImGui::CalcTextSize(most.c_str()).x, at.y + height + 1.0f}, grey,
                  most.c_str());
}

/// From which share of samples without gaze the figure is coloured: it asks for a look, no more.
constexpr double noticeable_loss = 0.1;

bool is_in_trial(const SessionView& view) {
    for (int i = 0; i < session_phase_count; ++i)
        if (name_of(static_cast<SessionPhase>(i)) == view.phase)
            return overt::is_in_trial(static_cast<SessionPhase>(i));
    return false;
}

} // namespace

void WatchPanels::send(const OperatorCommand& command) {
    says_ = words_of(command) + (client_.send(command) ? ": sent" : ": not sent, the session is gone");
}

void WatchPanels::draw(const ViewText& text, const WatchedSession& session, const WatchPictures& pictures,
                       std::optional<double> delay_s, float width, float height) {
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize({width, height});
    ImGui::Begin("overt", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
    const float below = 130.0f;
    ImGui::BeginChild("left", {left_share * width, -below});
    ImGui::BeginChild("display", {0.0f, display_share * (height - below)}, true,
                      ImGuiWindowFlags_NoScrollbar);
    draw_display(text, session, pictures);
    ImGui::EndChild();
    ImGui::BeginChild("saliency", {0.0f, 0.0f}, true, ImGuiWindowFlags_NoScrollbar);
    draw_saliency(text, session);
    ImGui::EndChild();
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginChild("right", {0.0f, -below});
    ImGui::BeginChild("figures", {0.0f, 0.56f * (height - below)}, true);
    draw_figures(text, delay_s);
    ImGui::EndChild();
    ImGui::BeginChild("messages", {0.0f, 0.0f}, true);
    draw_messages(text);
    ImGui::EndChild();
    ImGui::EndChild();
    ImGui::BeginChild("commands", {0.0f, 0.0f}, true);
    draw_commands(text);
    ImGui::EndChild();
    draw_confirmation(text);
    ImGui::End();
}

void WatchPanels::draw_display(const ViewText& text, const WatchedSession& session,
                               const WatchPictures& pictures) {
    display_ = {};
    const SessionFacts& facts = text.facts;
    const ImVec2 room = ImGui::GetContentRegionAvail(), at = ImGui::GetCursorScreenPos();
    if (facts.width_px <= 0 || facts.height_px <= 0)
        return;
    // The whole display, with the stimuli where they are.
    const float scale =
        std::min(room.x / static_cast<float>(facts.width_px), room.y / static_cast<float>(facts.height_px));
    const ImVec2 size{scale * static_cast<float>(facts.width_px),
                      scale * static_cast<float>(facts.height_px)};
    const ImVec2 corner{at.x + 0.5f * (room.x - size.x), at.y + 0.5f * (room.y - size.y)};
    ImDrawList& draws = *ImGui::GetWindowDrawList();
    draws.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, IM_COL32(12, 12, 12, 255));
    const ImVec2 middle{corner.x + 0.5f * size.x, corner.y + 0.5f * size.y};
    if (pictures.camera && session.camera()) {
        const ViewedCamera& camera = *session.camera();
        const float enlarged = std::min(size.x / static_cast<float>(camera.width_px),
                                        (size.y - 24.0f) / static_cast<float>(camera.height_px));
        const ImVec2 top_left{middle.x - 0.5f * enlarged * static_cast<float>(camera.width_px),
                              corner.y + 22.0f};
        draws.AddImage(texture_of(pictures.camera), top_left,
                       {top_left.x + enlarged * static_cast<float>(camera.width_px),
                        top_left.y + enlarged * static_cast<float>(camera.height_px)});
        const std::string words =
            fmt::format("the tracker's camera{}{}", camera.title.empty() ? "" : ": ", camera.title);
        draws.AddText({corner.x + 6.0f, corner.y + 2.0f}, IM_COL32(220, 220, 220, 255), words.c_str());
        return;
    }
    for (std::size_t i = 0; i < std::min(pictures.stimuli.size(), text.view.shown.size()); ++i) {
        const ViewedStimulus& shown = text.view.shown[i];
        const auto slot = static_cast<std::size_t>(shown.slot);
        if (!pictures.stimuli[i] || shown.pose < 0 || slot >= facts.slots.size())
            continue;
        const ViewedSlot& box = facts.slots[slot];
        const ImVec2 first{corner.x + scale * static_cast<float>(box.left_px),
                           corner.y + scale * static_cast<float>(box.top_px)};
        draws.AddImage(texture_of(pictures.stimuli[i]), first,
                       {first.x + scale * static_cast<float>(box.width_px),
                        first.y + scale * static_cast<float>(box.height_px)});
    }
    draws.AddRect(corner, {corner.x + size.x, corner.y + size.y}, IM_COL32(90, 90, 90, 255));
    display_ = {{corner.x, corner.y}, {size.x, size.y}, scale};
    if (!text.view.is_lit()) {
        const std::string words = text.view.is_over ? "the session is over" : text.view.phase;
        const ImVec2 wide = ImGui::CalcTextSize(words.c_str());
        draws.AddText({middle.x - 0.5f * wide.x, middle.y - 0.5f * wide.y}, IM_COL32(160, 160, 160, 255),
                      words.c_str());
    }
}

void WatchPanels::draw_saliency(const ViewText& text, const WatchedSession& session) {
    surface_drawn_ = {};
    const auto looked_at = static_cast<std::size_t>(session.looked_at());
    const std::string name = looked_at < text.view.shown.size() ? text.view.shown[looked_at].object : "",
                      slot = session.slot_of(session.looked_at());
    ImGui::TextColored(quiet, "gaze on %s%s%s", name.empty() ? "the object" : name.c_str(),
                       slot.empty() ? "" : ", ", slot.c_str());
    ImGui::SameLine();
    if (ImGui::RadioButton("all seen here", !of_trial_))
        of_trial_ = false;
    ImGui::SameLine();
    if (ImGui::RadioButton("this trial", of_trial_))
        of_trial_ = true;
    saliency_.show(of_trial_ ? LiveSaliency::Of::trial : LiveSaliency::Of::session);
    ImGui::SameLine();
    if (ImGui::SmallButton("Front"))
        orbit_ = {};
    const ImVec2 at = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
    const auto object = session.object();
    const auto map = object ? saliency_.newest(object->id(), slot) : nullptr;
    if (!map || room.x < 40.0f || room.y < 40.0f) {
        ImGui::TextColored(quiet, "%s",
                           name.empty() ? "shown with the first trial"
                           : object     ? "the surface is being prepared"
                                        : "no mesh, or it is being read");
        return;
    }
    ImDrawList& draws = *ImGui::GetWindowDrawList();
    draws.AddImage(
        texture_of(surface_.draw(*object, map, orbit_, {static_cast<int>(room.x), static_cast<int>(room.y)})),
        at, {at.x + room.x, at.y + room.y}, {0.0f, 1.0f}, {1.0f, 0.0f});
    ImGui::InvisibleButton("turn", room);
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 0.0f))
        orbit_.drag({static_cast<double>(ImGui::GetIO().MouseDelta.x),
                     static_cast<double>(ImGui::GetIO().MouseDelta.y)});
    if (ImGui::IsItemHovered() && ImGui::GetIO().MouseWheel != 0.0f)
        orbit_.zoom(static_cast<double>(ImGui::GetIO().MouseWheel));
    draw_scale(draws, {at.x + 10.0f, at.y + room.y - 34.0f}, 150.0f, "most");
    const std::string total = fmt::format("{:.1f} s of gaze; drag to turn, wheel for size", map->gaze_s);
    draws.AddText({at.x + room.x - ImGui::CalcTextSize(total.c_str()).x - 6.0f, at.y + room.y - 22.0f},
                  IM_COL32(160, 160, 160, 255), total.c_str());
    float down = at.y + 6.0f;
    for (const AreaTally::Share& area : map->areas) {
        if (down > at.y + room.y - 50.0f)
            break;
        const std::string words = fmt::format("{} {:.0f} %", area.area, 100.0 * area.share);
        draws.AddText({at.x + room.x - ImGui::CalcTextSize(words.c_str()).x - 6.0f, down},
                      IM_COL32(210, 210, 210, 255), words.c_str());
        down += ImGui::GetTextLineHeight();
    }
    surface_drawn_ = {{at.x, at.y}, {room.x, room.y}, 1.0f};
}

std::vector<Mark> WatchPanels::marks(const WatchedSession& session) const {
    std::vector<Mark> marks;
    if (asked_) // the question stands in front of all
        return marks;
    const auto is_within = [](const Drawn& drawn, glm::vec2 place) {
        const glm::vec2 inside = place - drawn.corner_px;
        return inside.x >= 0.0f && inside.y >= 0.0f && inside.x < drawn.size_px.x &&
               inside.y < drawn.size_px.y;
    };
    const std::deque<ViewedGaze>& gaze = session.gaze();
    for (std::size_t i = 0; i < gaze.size() && display_.scale > 0.0f; ++i) {
        if (!gaze[i].place)
            continue;
        const glm::vec2 place =
            display_.corner_px + display_.scale * glm::vec2(gaze[i].place->x_px, gaze[i].place->y_px);
        if (!is_within(display_, place))
            continue;
        const float strength = 0.25f + 0.75f * static_cast<float>(i + 1) / static_cast<float>(gaze.size());
        const glm::vec4 colour = gaze[i].is_right ? glm::vec4(1.0f, 0.67f, 0.16f, strength)
                                                  : glm::vec4(0.27f, 0.7f, 1.0f, strength);
        const bool is_newest = i + 1 == gaze.size();
        marks.push_back({place, is_newest ? 9.0f : 2.5f, is_newest ? 2.5f : 0.0f, colour});
    }
    if (surface_drawn_.scale > 0.0f && session.object() && session.last_gaze() && session.last_gaze()->hit &&
        session.last_gaze()->gaze.shown == session.looked_at())
        if (const auto place = surface_.place_of(*session.object(), session.last_gaze()->hit->position)) {
            const glm::vec2 at = surface_drawn_.corner_px + glm::vec2(place->px);
            if (is_within(surface_drawn_, at))
                marks.push_back({at,
                                 7.0f,
                                 place->is_hidden ? 1.5f : 3.0f,
                                 {1.0f, 0.43f, 0.24f, place->is_hidden ? 0.45f : 1.0f}});
        }
    return marks;
}

void WatchPanels::draw_figures(const ViewText& text, std::optional<double> delay_s) {
    const SessionFacts& facts = text.facts;
    const SessionView& view = text.view;
    row("session", fmt::format("{}, observer {}", facts.protocol, facts.observer));
    row("now", view.is_over      ? std::string("the session is over")
               : view.trial >= 0 ? fmt::format("trial {} of {}, {}", view.trial + 1, facts.trials, view.phase)
                                 : view.phase);
    ImGui::ProgressBar(facts.trials > 0 ? static_cast<float>(view.done) / static_cast<float>(facts.trials)
                                        : 0.0f,
                       {-1.0f, 0.0f}, fmt::format("{} of {} trials", view.done, facts.trials).c_str());
    row("time", fmt::format("{} left, {} gone",
                            duration_text(view.is_over ? std::optional(0.0) : time_left_s(facts, view)),
                            duration_text(view.time_s)));
    row("failed attempts", fmt::format("{}", view.failed));
    if (!view.task.empty())
        row("stimulus", fmt::format("{}: {}", words_of_shown(facts, view), view.question));
    ImGui::Separator();
    row("missed refreshes", missed_text(facts, view), !facts.is_timing_unproven && view.missed_in_trial > 0);
    if (!facts.has_tracker)
        row("eye tracker", "none");
    else {
        row("eye tracker",
            view.tracker_is_lost                          ? "lost"
            : text.gaze.empty() || text.gaze.back().place ? "connected"
                                                          : "no eye",
            view.tracker_is_lost);
        row("without gaze",
            fmt::format("{} in this trial, {} in all", share(view.samples_in_trial, view.lost_in_trial),
                        share(view.samples, view.lost)),
            lost_share(view.samples_in_trial, view.lost_in_trial).value_or(0.0) > noticeable_loss);
        if (!text.surface.empty())
            row("on the surface", text.surface);
        if (delay_s)
            row("shown after", fmt::format("{:.1f} ms", 1e3 * *delay_s));
        row("validation",
            fmt::format("mean {}, largest {}", degrees(view.validation_mean_deg),
                        degrees(view.validation_max_deg)),
            view.validation_mean_deg.value_or(0.0) > facts.mean_limit_deg ||
                view.validation_max_deg.value_or(0.0) > facts.max_limit_deg);
        row("drift", degrees(view.drift_deg), view.drift_deg.value_or(0.0) > facts.drift_limit_deg);
    }
    if (view.level_peak) {
        ImGui::TextColored(view.is_clipping ? poor : quiet, "%s",
                           view.is_clipping ? "voice: too loud" : "voice");
        ImGui::SameLine(130.0f);
        ImGui::ProgressBar(static_cast<float>(std::sqrt(std::clamp(*view.level_peak, 0.0, 1.0))),
                           {-1.0f, 0.0f}, "");
    } else if (!view.answer.empty()) {
        row("last answer", view.answer);
    }
    if (view.dropped > 0)
        row("this view", fmt::format("{} pieces of news found no room; the record has them", view.dropped));
    if (text.is_silent && !view.is_over)
        row("this view", "the session has said nothing for seconds", true);
}

void WatchPanels::draw_messages(const ViewText& text) {
    for (const ViewedEvent& event : text.events) {
        ImGui::TextColored(quiet, "%8.1f s", event.at_s);
        ImGui::SameLine();
        ImGui::TextWrapped("%s%s%s", event.kind.c_str(), event.detail.empty() ? "" : ": ",
                           event.detail.c_str());
    }
    // At its end, unless the operator reads further up.
    if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY() - 30.0f)
        ImGui::SetScrollHereY(1.0f);
}

void WatchPanels::draw_commands(const ViewText& text) {
    const auto command = [](const char* words) { return operator_command(words).value(); };
    if (!text.view.asks.empty()) {
        ImGui::TextColored(poor, "The session asks: %s", text.view.asks.c_str());
        ImGui::SameLine();
        if (ImGui::Button("Yes"))
            send(command("yes"));
        ImGui::SameLine();
        if (ImGui::Button("No"))
            send(command("no"));
    }
    const bool is_paused = text.view.phase == name_of(SessionPhase::pause);
    ImGui::BeginDisabled(text.view.is_over);
    if (ImGui::Button(is_paused ? "Go on" : "Pause"))
        send(command("pause"));
    ImGui::SameLine();
    if (ImGui::Button("Recalibrate"))
        asked_ = command("recalibrate");
    ImGui::BeginDisabled(!is_in_trial(text.view));
    for (const auto& [label, words] : {std::pair{"Drift check", "drift check"}, std::pair{"Repeat", "repeat"},
                                       std::pair{"Reject", "reject"}, std::pair{"Skip", "skip"}}) {
        ImGui::SameLine();
        if (ImGui::Button(label))
            asked_ = command(words);
    }
    ImGui::EndDisabled();
    ImGui::SameLine(0.0f, 40.0f);
    if (ImGui::Button("End the session"))
        asked_ = command("abort");
    ImGui::EndDisabled();
    ImGui::SetNextItemWidth(-110.0f);
    const bool is_entered = ImGui::InputTextWithHint("##note", "a note for the record", note_.data(),
                                                     note_.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    if ((ImGui::Button("Add note") || is_entered) && note_[0] != '\0') {
        if (const auto note = operator_command("note " + std::string(note_.data()))) {
            send(*note);
            note_.fill('\0');
        }
    }
    ImGui::TextColored(quiet, "%s", says_.c_str());
}

void WatchPanels::draw_confirmation(const ViewText& text) {
    if (!asked_)
        return;
    constexpr const char* name = "Are you sure?";
    ImGui::OpenPopup(name);
    const ImVec2 middle = ImGui::GetMainViewport()->GetCenter();
    ImGui::SetNextWindowPos(middle, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(name, nullptr,
                                ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
        return;
    ImGui::Text("%s%s", words_of(*asked_).c_str(),
                text.view.trial >= 0 ? fmt::format(", in trial {}", text.view.trial + 1).c_str() : "");
    std::optional<OperatorCommand> sure;
    if (ImGui::Button("Yes, do it", {140.0f, 0.0f}))
        sure = asked_;
    if (asked_->key == ResponsePress::Key::skip)
        for (std::size_t i = 0; i < std::min<std::size_t>(text.facts.skip_reasons.size(), 9); ++i)
            if (ImGui::Button(fmt::format("Yes: {}", text.facts.skip_reasons[i]).c_str())) {
                sure = asked_;
                sure->reason = static_cast<int>(i) + 1;
            }
    const bool is_left =
        ImGui::Button("No", {140.0f, 0.0f}) || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
    if (sure)
        send(*sure);
    if (sure || is_left) {
        asked_.reset();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

} // namespace overt
