#include "app/watch/live_saliency.h"

#include <algorithm>
#include <chrono>
#include <set>

#include <sys/resource.h>
#include <unistd.h>

#include "experiment/surface/coarse_surface.h"
#include "experiment/surface/surface_smoother.h"

namespace overt {

namespace {

constexpr std::size_t most_nodes = 8'000;
constexpr double kernel_deg = 1.0;
constexpr std::chrono::milliseconds between_maps{500};

std::uint32_t nearest_corner(const Mesh& mesh, const RayHit& hit) {
    const glm::dvec3& weights = hit.barycentric;
    const int corner = weights.x >= weights.y && weights.x >= weights.z ? 0 : weights.y >= weights.z ? 1 : 2;
    return mesh.triangles[hit.triangle][corner];
}

} // namespace

/// What a map is made with; of a large mesh only the coarse surface is kept.
struct LiveSaliency::Surface {
    explicit Surface(const WatchedObject& object)
        : sigma(kernel_deg * object.degree_on_surface()), part_names(object.mesh().part_names) {
        const SurfaceGeometry fine(object.mesh());
        const CoarseSurface coarse(fine, most_nodes);
        mesh = std::make_shared<Mesh>(coarse.mesh());
        vertex_near.resize(fine.vertex_count());
        for (std::uint32_t v = 0; v < vertex_near.size(); ++v)
            vertex_near[v] = coarse.vertex_near(fine.node_of(v));
        for (std::uint32_t v = 0; v < coarse.vertex_count(); ++v)
            places.push_back(coarse.place_of(v));
        geometry = std::make_unique<SurfaceGeometry>(*mesh);
        smoother = std::make_unique<SurfaceSmoother>(*geometry, sigma);
    }

    /// Gaze in one slot.
    struct Sums {
        std::vector<double> session_s, trial_s; ///< by vertex of `mesh`
        AreaTally areas;
        int trial = -1;
    };
    Sums& sums_in(const std::string& slot) {
        const std::vector<double> none(places.size());
        return sums.try_emplace(slot, Sums{none, none, AreaTally(part_names)}).first->second;
    }

    void add(const std::string& slot, int in_trial, std::uint32_t vertex, PartIndex part, double seconds) {
        Sums& in_slot = sums_in(slot);
        if (in_trial != in_slot.trial) {
            std::ranges::fill(in_slot.trial_s, 0.0);
            in_slot.trial = in_trial;
        }
        const std::uint32_t near = vertex_near[vertex];
        in_slot.session_s[near] += seconds;
        in_slot.trial_s[near] += seconds;
        in_slot.areas.add(in_trial, part, seconds);
    }

    SaliencyMap map(Of of, const std::string& object, const std::string& slot) {
        const Sums& in_slot = sums_in(slot);
        const std::vector<double>& seconds = of == Of::session ? in_slot.session_s : in_slot.trial_s;
        SaliencyMap map{object, slot, mesh, {}, 0.0, in_slot.areas.shares(of == Of::trial)};
        std::vector<SurfaceWeight> weights;
        for (std::size_t v = 0; v < seconds.size(); ++v)
            if (seconds[v] > 0.0) {
                weights.push_back({places[v], seconds[v], sigma});
                map.gaze_s += seconds[v];
            }
        map.share.assign(seconds.size(), 0.0f);
        if (weights.empty())
            return map;
        const std::vector<double> density = smoother->density(weights);
        const double most = *std::ranges::max_element(density);
        std::ranges::transform(density, map.share.begin(), [most](double here) {
            return most > 0.0 ? static_cast<float>(here / most) : 0.0f;
        });
        return map;
    }

    double sigma;
    std::shared_ptr<const Mesh> mesh;
    std::vector<std::uint32_t> vertex_near; ///< by vertex of the object's mesh: of `mesh`
    std::vector<SurfacePlace> places;       ///< by vertex of `mesh`
    std::unique_ptr<SurfaceGeometry> geometry;
    std::unique_ptr<SurfaceSmoother> smoother;
    std::vector<std::string> part_names;
    std::map<std::string, Sums> sums; ///< by slot
};

LiveSaliency::LiveSaliency() : thread_([this](const std::stop_token& stop) { work(stop); }) {}

LiveSaliency::~LiveSaliency() {
    thread_.request_stop();
    wakes_.notify_all();
}

void LiveSaliency::looked(const std::shared_ptr<const WatchedObject>& object, const std::string& slot,
                          int trial, const RayHit& hit, double seconds) {
    {
        const std::lock_guard lock(lock_);
        looks_.push_back({object, slot, trial, nearest_corner(object->mesh(), hit),
                          object->mesh().triangle_parts[hit.triangle], seconds});
    }
    wakes_.notify_one();
}

void LiveSaliency::prepare(const std::shared_ptr<const WatchedObject>& object, const std::string& slot) {
    {
        const std::lock_guard lock(lock_);
        looks_.push_back({object, slot, -1, 0, 0, 0.0});
    }
    wakes_.notify_one();
}

void LiveSaliency::show(Of what) {
    {
        const std::lock_guard lock(lock_);
        is_other_ = is_other_ || of_ != what;
        of_ = what;
    }
    wakes_.notify_one();
}

std::shared_ptr<const SaliencyMap> LiveSaliency::newest(const std::string& object,
                                                        const std::string& slot) const {
    const std::lock_guard lock(lock_);
    const auto found = newest_.find({object, slot});
    return found == newest_.end() ? nullptr : found->second;
}

LiveSaliency::Surface& LiveSaliency::surface_of(const WatchedObject& object) {
    std::unique_ptr<Surface>& surface = surfaces_[object.id()];
    if (!surface)
        surface = std::make_unique<Surface>(object);
    return *surface;
}

void LiveSaliency::work(const std::stop_token& stop) {
    // A thread's own, on Linux: whatever else the machine does goes first.
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), 10);
    std::set<std::pair<std::string, std::string>> known; // objects and slots
    while (!stop.stop_requested()) {
        std::vector<Look> looks;
        Of of = Of::session;
        std::set<std::pair<std::string, std::string>> changed;
        {
            std::unique_lock lock(lock_);
            wakes_.wait(lock, stop, [&] { return !looks_.empty() || is_other_; });
            looks.swap(looks_);
            if (is_other_)
                changed = known;
            is_other_ = false;
            of = of_;
        }
        for (const Look& look : looks) {
            Surface& surface = surface_of(*look.object);
            changed.emplace(look.object->id(), look.slot);
            if (look.seconds > 0.0)
                surface.add(look.slot, look.trial, look.vertex, look.part, look.seconds);
        }
        known.insert(changed.begin(), changed.end());
        for (const auto& [object, slot] : changed) {
            if (stop.stop_requested())
                break;
            auto map = std::make_shared<const SaliencyMap>(surfaces_.at(object)->map(of, object, slot));
            const std::lock_guard lock(lock_);
            newest_[{object, slot}] = std::move(map);
        }
        std::unique_lock lock(lock_);
        wakes_.wait_for(lock, stop, between_maps, [] { return false; });
    }
}

} // namespace overt
