/// Maps as the program exports them, read back without its own code: what a reader would add up.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace overt::test {

inline std::string bytes_of_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

template <class T> T number_at(const std::string& bytes, std::size_t place) {
    T value;
    if (place + sizeof(T) > bytes.size())
        throw std::runtime_error("the file ends too early");
    std::memcpy(&value, bytes.data() + place, sizeof(T));
    return value;
}

/// A mesh with a value at each vertex, in the file's own units.
struct ReadMap {
    std::vector<glm::dvec3> positions;
    std::vector<double> values;
    std::vector<glm::uvec3> triangles;
    std::string legend; ///< what the file says of itself

    /// Of the value, between the vertices linearly, over the area.
    double integral() const {
        double sum = 0.0;
        for (const glm::uvec3& t : triangles)
            sum += 0.5 *
                   glm::length(glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x])) *
                   (values[t.x] + values[t.y] + values[t.z]) / 3.0;
        return sum;
    }
    glm::dvec3 low() const {
        glm::dvec3 least = positions.front();
        for (const glm::dvec3& position : positions)
            least = glm::min(least, position);
        return least;
    }
    glm::dvec3 high() const {
        glm::dvec3 most = positions.front();
        for (const glm::dvec3& position : positions)
            most = glm::max(most, position);
        return most;
    }
};

inline ReadMap read_glb(const std::string& path) {
    const std::string bytes = bytes_of_file(path);
    const auto json_bytes = number_at<std::uint32_t>(bytes, 12);
    const nlohmann::json json = nlohmann::json::parse(bytes.substr(20, json_bytes));
    const std::size_t binary = 20 + json_bytes + 8;
    const auto& primitive = json.at("meshes").at(0).at("primitives").at(0);
    const auto begin_of = [&](const nlohmann::json& accessor) {
        const auto& view = json.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
        return binary + view.at("byteOffset").get<std::size_t>();
    };
    ReadMap map;
    map.legend = json.at("meshes").at(0).at("extras").dump();
    const auto& places =
        json.at("accessors").at(primitive.at("attributes").at("POSITION").get<std::size_t>());
    const auto& values =
        json.at("accessors").at(primitive.at("attributes").at("_SALIENCY").get<std::size_t>());
    const auto& indices = json.at("accessors").at(primitive.at("indices").get<std::size_t>());
    const std::size_t count = places.at("count");
    for (std::size_t v = 0; v < count; ++v) {
        glm::dvec3 position;
        for (int axis = 0; axis < 3; ++axis)
            position[axis] = static_cast<double>(
                number_at<float>(bytes, begin_of(places) + 12 * v + 4 * static_cast<std::size_t>(axis)));
        map.positions.push_back(position);
        map.values.push_back(static_cast<double>(number_at<float>(bytes, begin_of(values) + 4 * v)));
    }
    for (std::size_t i = 0; i < indices.at("count").get<std::size_t>(); i += 3) {
        const std::size_t at = begin_of(indices) + 4 * i;
        map.triangles.emplace_back(number_at<std::uint32_t>(bytes, at),
                                   number_at<std::uint32_t>(bytes, at + 4),
                                   number_at<std::uint32_t>(bytes, at + 8));
    }
    return map;
}

/// With the properties of the program's own files: x y z, red green blue, saliency.
inline ReadMap read_coloured_ply(const std::string& path) {
    const std::string bytes = bytes_of_file(path);
    const std::size_t end = bytes.find("end_header\n") + 11;
    std::istringstream head(bytes.substr(0, end));
    ReadMap map;
    std::size_t vertices = 0, faces = 0;
    for (std::string line; std::getline(head, line);) {
        std::sscanf(line.c_str(), "element vertex %zu", &vertices);
        std::sscanf(line.c_str(), "element face %zu", &faces);
        if (line.starts_with("comment "))
            map.legend += line.substr(8) + "\n";
    }
    std::size_t at = end;
    for (std::size_t v = 0; v < vertices; ++v, at += 19) {
        map.positions.emplace_back(number_at<float>(bytes, at), number_at<float>(bytes, at + 4),
                                   number_at<float>(bytes, at + 8));
        map.values.push_back(static_cast<double>(number_at<float>(bytes, at + 15)));
    }
    for (std::size_t f = 0; f < faces; ++f, at += 13)
        map.triangles.emplace_back(number_at<std::uint32_t>(bytes, at + 1),
                                   number_at<std::uint32_t>(bytes, at + 5),
                                   number_at<std::uint32_t>(bytes, at + 9));
    return map;
}

/// Voxels of a NRRD file with a raw body of 32-bit floats and equal spacing.
struct ReadVolume {
    double integral = 0.0;  ///< of the value over the space, in the file's own unit
    glm::dvec3 centre{0.0}; ///< mean place, weighted by the value
    std::string head;
};

inline ReadVolume read_nrrd(const std::string& path) {
    const std::string bytes = bytes_of_file(path);
    std::size_t at = bytes.find("\n\n") + 2;
    ReadVolume volume;
    volume.head = bytes.substr(0, at);
    std::istringstream head(volume.head);
    glm::ivec3 cells{0};
    glm::dvec3 origin{0.0};
    double cell = 0.0;
    for (std::string line; std::getline(head, line);) {
        std::sscanf(line.c_str(), "sizes: %d %d %d", &cells.x, &cells.y, &cells.z);
        std::sscanf(line.c_str(), "space origin: (%lf,%lf,%lf)", &origin.x, &origin.y, &origin.z);
        std::sscanf(line.c_str(), "space directions: (%lf", &cell);
    }
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x, at += 4) {
                const auto value = static_cast<double>(number_at<float>(bytes, at));
                volume.integral += value;
                volume.centre += value * (origin + cell * glm::dvec3(x, y, z));
            }
    if (at != bytes.size())
        throw std::runtime_error("the file is longer than its header says");
    volume.centre /= volume.integral;
    volume.integral *= cell * cell * cell;
    return volume;
}

} // namespace overt::test
