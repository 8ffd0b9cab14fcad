#include "experiment/maps/reconstruction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

#include "experiment/base/parallel.h"

namespace overt {

namespace {

constexpr glm::ivec2 right{1, 0}, down{0, 1};

/// What one pose shows at its pixel centres.
class SurfaceGrid {
  public:
    SurfaceGrid(const SurfaceLookup& lookup, PoseIndex pose, glm::ivec2 size_px)
        : size_(size_px), pixels_(static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y)) {
        parallel_for(size_.y, [&](int y) {
            for (int x = 0; x < size_.x; ++x) {
                Pixel& pixel = pixels_[index_of({x, y})];
                const auto surface = lookup.surface_at(pose, {x + 0.5, y + 0.5});
                if (!surface)
                    continue;
                pixel.position = surface->position;
                pixel.part = surface->part;
                pixel.covered = true;
                pixel.joined_right =
                    x + 1 < size_.x && lookup.goes_on(pose, {x, y}, glm::ivec2(x, y) + right);
                pixel.joined_down = y + 1 < size_.y && lookup.goes_on(pose, {x, y}, glm::ivec2(x, y) + down);
            }
        });
        // A look-up through the centre may miss where the map has a pixel covered.
        for (int y = 0; y < size_.y; ++y) {
            for (int x = 0; x < size_.x; ++x) {
                Pixel& pixel = pixels_[index_of({x, y})];
                pixel.joined_right = pixel.joined_right && covers(glm::ivec2(x, y) + right);
                pixel.joined_down = pixel.joined_down && covers(glm::ivec2(x, y) + down);
            }
        }
    }

    glm::ivec2 size() const { return size_; }
    std::size_t index_of(glm::ivec2 at) const {
        return static_cast<std::size_t>(at.y) * static_cast<std::size_t>(size_.x) +
               static_cast<std::size_t>(at.x);
    }
    bool covers(glm::ivec2 at) const { return pixels_[index_of(at)].covered; }
    glm::dvec3 position(glm::ivec2 at) const { return pixels_[index_of(at)].position; }
    PartIndex part(glm::ivec2 at) const { return pixels_[index_of(at)].part; }
    bool is_joined_right(glm::ivec2 at) const { return pixels_[index_of(at)].joined_right; }
    bool is_joined_down(glm::ivec2 at) const { return pixels_[index_of(at)].joined_down; }

    /// Towards the eye; from the joined neighbours. Nothing for a pixel that stands alone in a row or column.
    std::optional<glm::vec3> normal(glm::ivec2 at) const {
        const glm::dvec3 across = slope(at, right), along = slope(at, down);
        const glm::dvec3 normal = glm::cross(along, across);
        const double length = glm::length(normal);
        return length > 0.0 ? std::optional(glm::vec3(normal / length)) : std::nullopt;
    }

    /// Median distance of joined neighbours in a row; 0 if there are none.
    double usual_step() const {
        std::vector<double> steps;
        for (int y = 0; y < size_.y; ++y) {
            for (int x = 0; x < size_.x; ++x) {
                if (is_joined_right({x, y}))
                    steps.push_back(glm::distance(position({x, y}), position(glm::ivec2(x, y) + right)));
            }
        }
        if (steps.empty())
            return 0.0;
        const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
        std::nth_element(steps.begin(), middle, steps.end());
        return *middle;
    }

  private:
    struct Pixel {
        glm::dvec3 position{0.0};
        PartIndex part = 0;
        bool covered = false, joined_right = false, joined_down = false;
    };

    bool is_joined(glm::ivec2 at, glm::ivec2 step) const {
        if (step.x < 0 || step.y < 0)
            return at.x + step.x >= 0 && at.y + step.y >= 0 && is_joined(at + step, -step);
        return step.x > 0 ? is_joined_right(at) : is_joined_down(at);
    }
    glm::dvec3 slope(glm::ivec2 at, glm::ivec2 step) const {
        const bool ahead = is_joined(at, step), behind = is_joined(at, -step);
        return (ahead ? position(at + step) : position(at)) - (behind ? position(at - step) : position(at));
    }

    glm::ivec2 size_;
    std::vector<Pixel> pixels_;
};

/// Collects the points of triangles, each point once.
class SurfaceBuilder {
  public:
    explicit SurfaceBuilder(const SurfaceGrid& grid)
        : grid_(grid),
          point_of_(static_cast<std::size_t>(grid.size().x) * static_cast<std::size_t>(grid.size().y), none) {
    }

    /// The triangles of the square whose top left corner is a pixel.
    void add_square(glm::ivec2 top_left) {
        const glm::ivec2 top_right = top_left + right, bottom_left = top_left + down,
                         bottom_right = bottom_left + right;
        const bool top = grid_.is_joined_right(top_left), bottom = grid_.is_joined_right(bottom_left),
                   left = grid_.is_joined_down(top_left), right_side = grid_.is_joined_down(top_right);
        if (top && bottom && left && right_side) {
            // Along the shorter diagonal.
            if (glm::distance(grid_.position(top_left), grid_.position(bottom_right)) <
                glm::distance(grid_.position(top_right), grid_.position(bottom_left))) {
                add(top_left, bottom_left, bottom_right);
                add(top_left, bottom_right, top_right);
            } else {
                add(top_left, bottom_left, top_right);
                add(bottom_right, top_right, bottom_left);
            }
        } else if (top && left) {
            add(top_left, bottom_left, top_right);
        } else if (bottom && right_side) {
            add(bottom_right, top_right, bottom_left);
        } else if (left && bottom) {
            add(top_left, bottom_left, bottom_right);
        } else if (top && right_side) {
            add(top_left, bottom_right, top_right);
        }
    }

    Reconstruction finish() {
        surface_.views.assign(surface_.positions.size(), 1);
        return std::move(surface_);
    }

  private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    void add(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
        const glm::uvec3 triangle(point_at(a), point_at(b), point_at(c));
        surface_.triangles.push_back(triangle);
        // A pixel that is joined to others in its row alone, or in its column, has this triangle's normal.
        const glm::dvec3 normal = glm::normalize(
            glm::cross(grid_.position(b) - grid_.position(a), grid_.position(c) - grid_.position(a)));
        for (int corner = 0; corner < 3; ++corner) {
            glm::vec3& of_point = surface_.normals[triangle[corner]];
            if (of_point == glm::vec3(0.0f))
                of_point = glm::vec3(normal);
        }
    }
    std::uint32_t point_at(glm::ivec2 pixel) {
        std::uint32_t& point = point_of_[grid_.index_of(pixel)];
        if (point == none) {
            point = static_cast<std::uint32_t>(surface_.positions.size());
            surface_.positions.emplace_back(grid_.position(pixel));
            surface_.normals.push_back(grid_.normal(pixel).value_or(glm::vec3(0.0f)));
            surface_.parts.push_back(grid_.part(pixel));
        }
        return point;
    }

    const SurfaceGrid& grid_;
    std::vector<std::uint32_t> point_of_;
    Reconstruction surface_;
};

/// Keeps the first point of each cube of space.
class CloudBuilder {
  public:
    explicit CloudBuilder(double spacing) : spacing_(spacing) {}

    void add(const SurfaceGrid& grid, int pose) {
        for (int y = 0; y < grid.size().y; ++y) {
            for (int x = 0; x < grid.size().x; ++x) {
                if (!grid.covers({x, y}))
                    continue;
                if (const auto normal = grid.normal({x, y}))
                    add_point(grid.position({x, y}), *normal, grid.part({x, y}), pose);
            }
        }
    }

    Reconstruction finish() { return std::move(cloud_); }

  private:
    void add_point(glm::dvec3 position, glm::vec3 normal, PartIndex part, int pose) {
        const auto [known, is_new] =
            point_of_.try_emplace(cube_of(position), static_cast<std::uint32_t>(cloud_.positions.size()));
        if (is_new) {
            cloud_.positions.emplace_back(position);
            cloud_.normals.push_back(normal);
            cloud_.parts.push_back(part);
            cloud_.views.push_back(1);
            last_pose_.push_back(pose);
        } else if (last_pose_[known->second] != pose) {
            last_pose_[known->second] = pose;
            ++cloud_.views[known->second];
        }
    }
    std::uint64_t cube_of(glm::dvec3 position) const {
        // 21 bits for each axis: objects are a few thousand cubes wide.
        const auto bits = [&](double at) {
            return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(at / spacing_))) &
                   0x1fffffu;
        };
        return bits(position.x) << 42 | bits(position.y) << 21 | bits(position.z);
    }

    double spacing_;
    Reconstruction cloud_;
    std::vector<int> last_pose_;
    std::unordered_map<std::uint64_t, std::uint32_t> point_of_;
};

} // namespace

Reconstruction reconstruct_surface(const SurfaceLookup& lookup, PoseIndex pose, glm::ivec2 size_px) {
    const SurfaceGrid grid(lookup, pose, size_px);
    SurfaceBuilder builder(grid);
    for (int y = 0; y + 1 < size_px.y; ++y) {
        for (int x = 0; x + 1 < size_px.x; ++x)
            builder.add_square({x, y});
    }
    return builder.finish();
}

Reconstruction reconstruct_cloud(const SurfaceLookup& lookup, std::span<const PoseIndex> poses,
                                 glm::ivec2 size_px, double spacing,
                                 const std::function<void(int done, int all)>& progress) {
    std::optional<CloudBuilder> builder;
    int done = 0;
    for (const PoseIndex pose : poses) {
        const SurfaceGrid grid(lookup, pose, size_px);
        if (!builder) {
            const double usual = spacing > 0.0 ? spacing : grid.usual_step();
            builder.emplace(usual > 0.0 ? usual : 1.0);
        }
        builder->add(grid, done++);
        if (progress)
            progress(done, static_cast<int>(poses.size()));
    }
    return builder ? builder->finish() : Reconstruction{};
}

SeenArea seen_area(const CoordinateMaps& maps) {
    const Mesh& mesh = maps.mesh();
    std::vector<std::uint8_t> seen(mesh.triangles.size(), 0);
    const int poses = static_cast<int>(maps.pose_count());
    for (int pose = 0; pose < poses; ++pose) {
        for (const std::uint32_t code : maps.map({pose}).codes) {
            if (code != 0)
                seen[code - 1] = 1;
        }
    }
    const auto corner = [&](std::size_t t, int k) {
        return glm::dvec3(mesh.positions[mesh.triangles[t][k]]);
    };
    constexpr std::size_t batch = 1024;
    parallel_for(static_cast<int>((seen.size() + batch - 1) / batch), [&](int index) {
        const std::size_t begin = static_cast<std::size_t>(index) * batch;
        for (std::size_t t = begin; t < std::min(begin + batch, seen.size()); ++t) {
            const glm::dvec3 middle = (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3.0;
            for (int pose = 0; pose < poses && !seen[t]; ++pose)
                seen[t] = maps.is_visible({pose}, middle);
        }
    });
    SeenArea result;
    for (std::size_t t = 0; t < seen.size(); ++t) {
        const double area =
            0.5 * glm::length(glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)));
        result.area += area;
        if (!seen[t])
            result.never_seen += area;
    }
    return result;
}

} // namespace overt
