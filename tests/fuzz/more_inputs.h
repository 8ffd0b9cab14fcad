/// What is done with any bytes as a mesh, as a map, as texts that include each other and as a part of an
/// analysis: shared by the fuzzers and by the test that replays their corpus. None of these may do anything
/// but return.
#pragma once

#include <string>
#include <string_view>

#include "experiment/base/content_hash.h"
#include "experiment/maps/coordinate_image_file.h"
#include "experiment/maps/light_pictures.h"
#include "experiment/maps/triangle_map.h"
#include "experiment/protocol/files/characterisation_file.h"
#include "experiment/protocol/files/fault_file.h"
#include "experiment/scene/files/mesh_reader.h"
#include "experiment/study/read/study_shard.h"
#include "tests/fuzz/inputs.h"

namespace overt::fuzz {

template <class Work> void whatever_it_says(const Work& work) {
    try {
        work();
    } catch (const Error&) {
    }
}

/// PLY and STL are told by their content, all else is read as OBJ. Then cleaned and cut into parts.
inline void take_mesh(std::string_view bytes) {
    const ScratchFolder folder("overt-fuzz");
    const std::filesystem::path file = put(folder, "fuzz.obj", bytes);
    whatever_it_says([&] { read_mesh_file(file); });
    whatever_it_says([&] {
        MeshCleaningReport report;
        SurfaceAppearance appearance;
        const Mesh mesh = import_mesh(file, {}, report, &appearance);
        mean_looks(appearance, mesh);
    });
    whatever_it_says([&] {
        MeshCleaningReport report;
        MeshImport import;
        import.up = UpAxis::y;
        import.weld_tolerance = bytes.size() % 2 == 0 ? 0.0 : 0.01;
        import_mesh(file, import, report);
    });
}

/// As whatever file may say which parts a coloured square of two triangles has.
inline void take_labels(std::string_view bytes) {
    const ScratchFolder folder("overt-fuzz");
    MeshImport import;
    const std::filesystem::path mesh =
        put(folder, "square.obj",
            "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 0 1 0\nv 0 1 0 0 1 0\nf 1 2 3\nf 1 3 4\n");
    for (const char* name : {"fuzz.txt", "fuzz.annot", "fuzz.label"}) {
        import.labels = put(folder, name, bytes);
        whatever_it_says([&] {
            MeshCleaningReport report;
            import_mesh(mesh, import, report);
        });
    }
}

/// As a .glb or .gltf, with its materials and pictures.
inline void take_gltf(std::string_view bytes) {
    const ScratchFolder folder("overt-fuzz");
    const std::filesystem::path file = put(folder, "fuzz.glb", bytes);
    whatever_it_says([&] {
        MeshCleaningReport report;
        SurfaceAppearance appearance;
        const Mesh mesh = import_mesh(file, {}, report, &appearance);
        hash_of_appearance(appearance);
        mean_looks(appearance, mesh);
        for (std::uint32_t triangle = 0; triangle < std::min<std::size_t>(mesh.triangles.size(), 64);
             ++triangle)
            bump_at(appearance, triangle, {0.3f, 0.2f});
    });
}

/// The first byte says as what the others are read: T a map of triangles, C coordinates as EXR, P coordinates
/// as PNG, L the light of a stimulus.
inline void take_map(std::string_view bytes) {
    if (bytes.empty())
        return;
    const ScratchFolder folder("overt-fuzz");
    const bool is_png = bytes[0] == 'P';
    const std::filesystem::path file = put(folder, is_png ? "fuzz.png" : "fuzz.exr", bytes.substr(1));
    switch (bytes[0]) {
    case 'T':
        whatever_it_says([&] { read_triangle_map(file); });
        break;
    case 'L':
        whatever_it_says([&] { read_light_pictures(file, {64, 64}, 3); });
        break;
    default:
        whatever_it_says([&] { read_map_description(file); });
        whatever_it_says([&] { read_coordinate_image(file); });
    }
}

/// A protocol and what it includes, a.toml, b.toml, …, with lines of = between them; each is read as a
/// characterisation and as a file of faults, too.
inline void take_texts(std::string_view bytes) {
    constexpr std::string_view border = "\n====\n";
    IncludedTexts included;
    std::string_view protocol = bytes.substr(0, bytes.find(border));
    std::string_view rest = bytes.substr(std::min(bytes.size(), protocol.size() + border.size()));
    for (char name = 'a'; name <= 'z' && !rest.empty(); ++name) {
        const std::string_view text = rest.substr(0, rest.find(border));
        included[std::string(1, name) + ".toml"] = std::string(text);
        rest.remove_prefix(std::min(rest.size(), text.size() + border.size()));
        Diagnostics of_faults;
        read_fault_text(text, "fuzz.toml", of_faults);
        of_faults.print();
    }
    Diagnostics diagnostics;
    const std::string_view shipped[] = {"muse", "runner"};
    read_protocol_text(protocol, "fuzz.toml", shipped, diagnostics, included);
    diagnostics.print();
    const ScratchFolder folder("overt-fuzz");
    Diagnostics of_light;
    whatever_it_says(
        [&] { read_characterisation(put(folder, "fuzz.toml", protocol), "fuzz.toml", {}, of_light); });
    of_light.print();
}

/// What one shard of an analysis wrote, with the hash that belongs to it.
inline void take_shard(std::string_view bytes) {
    const ScratchFolder folder("overt-fuzz");
    put(folder, shard_file_name, std::string(bytes) + std::string(hash_of_text(bytes)));
    whatever_it_says([&] { read_shard(folder.path()); });
}

} // namespace overt::fuzz
