#include "render/stimulus/live_maps.h"

#include "render/stimulus/scene_view.h"

namespace overt {

namespace {

/// Reads under way at once: a new pose comes every 33 ms, so a few cover a tenth of a second of delay.
constexpr int reads_at_once = 4;

} // namespace

LiveMaps::LiveMaps(const GlContext& context, const Protocol& protocol, std::span<const Object> objects,
                   const PoseTable& poses)
    : protocol_(&protocol) {
    lit_.reserve(protocol.slots.size());
    for (std::size_t index = 0; index < objects.size(); ++index) {
        const Object& object = objects[index];
        views_ = object.scenes.size();
        buffers_.push_back(object.has_mesh() ? std::make_unique<MeshBuffers>(context, object.mesh) : nullptr);
        for (std::size_t view = 0; view < views_; ++view) {
            Figure& figure = figures_.emplace_back();
            figure.viewed = {static_cast<int>(index), static_cast<int>(view)};
            if (!object.has_mesh())
                continue;
            figure.image_px = object.scenes[view].view.image_px;
            figure.pass = &pass_of(context, figure.image_px);
            figure.buffers = buffers_.back().get();
            for (const ObjectPose& angle : poses.angles)
                figure.clip_from_object.push_back(clip_from_centred_object(object.scenes[view], angle));
            figure.states.assign(poses.angles.size(), State::missing);
            figure.maps.resize(poses.angles.size());
        }
    }
}

LiveMaps::Pass& LiveMaps::pass_of(const GlContext& context, glm::ivec2 image_px) {
    for (const std::unique_ptr<Pass>& pass : passes_)
        if (pass->drawing.target().size_px() == image_px)
            return *pass;
    Pass& pass = *passes_.emplace_back(std::make_unique<Pass>(CoordinatePass(context, image_px)));
    for (int i = 0; i < reads_at_once; ++i)
        pass.reads.push_back(
            {std::make_unique<PixelReadback>(context, image_px, PixelFormat::r32ui), nullptr, 0});
    return pass;
}

void LiveMaps::presentation_begins(const Trial& lit, int) noexcept {
    collect(true); // a show may follow another directly
    lit_.clear();
    for (std::size_t i = 0; i < lit.shown_count() && lit_.size() < lit_.capacity(); ++i) {
        lit_.push_back(&figure_of(viewed(protocol_->in_slot(lit.shown(i)))));
        make_ready(*lit_.back());
    }
}

void LiveMaps::make_ready(Figure& figure) noexcept {
    for (std::size_t pose = 0; pose < figure.states.size(); ++pose) {
        if (figure.states[pose] != State::missing)
            continue;
        figure.maps[pose].size_px = figure.image_px;
        figure.maps[pose].codes.resize(static_cast<std::size_t>(figure.image_px.x) *
                                       static_cast<std::size_t>(figure.image_px.y));
    }
}

void LiveMaps::flipped(const FlipRecord& flip) noexcept {
    collect(false);
    draw(*lit_.front(), flip.pose);
}

void LiveMaps::slot_flipped(const SlotFlip& flip) noexcept {
    if (const auto place = static_cast<std::size_t>(flip.place); place < lit_.size())
        draw(*lit_[place], flip.pose);
}

void LiveMaps::draw(Figure& figure, PoseIndex index) noexcept {
    const auto pose = static_cast<std::size_t>(index.value);
    if (!figure.buffers || figure.states[pose] != State::missing)
        return;
    CoordinatePass& drawing = figure.pass->drawing;
    for (Read& read : figure.pass->reads) {
        if (read.pixels->under_way())
            continue;
        drawing.render(*figure.buffers, figure.clip_from_object[pose]);
        read.pixels->start(drawing.target());
        read.figure = &figure;
        read.pose = index.value;
        figure.states[pose] = State::under_way;
        return;
    }
    // All reads are under way: the pose is lit for several refreshes and comes again in the next period.
}

void LiveMaps::collect(bool wait) noexcept {
    for (const std::unique_ptr<Pass>& pass : passes_) {
        for (Read& read : pass->reads) {
            if (!read.pixels->under_way())
                continue;
            const auto pose = static_cast<std::size_t>(read.pose);
            if (read.pixels->finish(std::as_writable_bytes(std::span(read.figure->maps[pose].codes)), wait))
                read.figure->states[pose] = State::done;
        }
    }
}

void LiveMaps::screen_shown(const Screen&, SessionTime) noexcept { collect(true); }

std::vector<LiveMap> LiveMaps::take_finished() {
    std::vector<LiveMap> finished;
    for (Figure& figure : figures_) {
        for (std::size_t pose = 0; pose < figure.states.size(); ++pose) {
            if (figure.states[pose] != State::done || figure.maps[pose].codes.empty())
                continue;
            finished.push_back({figure.viewed, {static_cast<int>(pose)}, std::move(figure.maps[pose])});
            figure.maps[pose] = {};
        }
    }
    return finished;
}

} // namespace overt
