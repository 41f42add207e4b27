#include "core/format/obj/materials.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "core/base/error.h"
#include "core/format/obj/mtl.h"
#include "core/format/obj/obj_document.h"

namespace coppice {

namespace {

std::string folder_of(std::string_view path) {
    const size_t slash = path.rfind('/');
    return std::string(slash == path.npos ? "" : path.substr(0, slash + 1));
}

class MaterialReader {
  public:
    MaterialReader(const ObjFile& file, const Resources& resources, const ReadLimits& limits, Scene& scene)
        : file_(file), resources_(resources), limits_(limits), scene_(scene) {}

    void read() {
        for (const std::string& line : file_.libraries) read_libraries(line);
        for (const std::string& name : file_.materials) scene_.materials.push_back(material(name));
        keep_other_textures();
        tally_.move_to(scene_.warnings);
        scene_.source = document_;
    }

  private:
    struct Found {
        const ResourceFile* file = nullptr;
        std::string path;  // where an OBJ writer puts it, so that the library finds it
    };

    // A path that leaves the upload is not followed: only its base name may match.
    Found find(std::string path, const std::string& folder, std::string_view where) {
        if (path.find('\\') != path.npos) {
            std::replace(path.begin(), path.end(), '\\', '/');
            tally_.note("obj.windows_path", "paths with backslashes were read with slashes", where);
        }
        try {
            require_inside_upload(path, where);
        } catch (const Error& error) {
            tally_.note("resource.forbidden", error.message() + "; only its base name was looked for", where);
            path = path.substr(path.find_last_of("/:") + 1);
            if (path.empty() || path == ".." || path.find('\0') != path.npos) return {};
        }
        const ResourceFile* beside = folder.empty() ? nullptr : resources_.find_path(folder + path, where);
        if (beside) return {beside, folder + path};
        return {resources_.find_path(path, where), path};
    }

    // One name with blanks in it, or several names.
    void read_libraries(const std::string& line) {
        if (line.find_first_of(" \t") != line.npos) {
            if (const Found whole = find(line, "", "mtllib"); whole.file) return read_library(whole);
        }
        for (size_t at = 0; at < line.size();) {
            const size_t end = std::min(line.find_first_of(" \t", at), line.size());
            const std::string name = line.substr(at, end - at);
            at = std::min(line.find_first_not_of(" \t", end), line.size());
            if (const Found found = find(name, "", "mtllib"); found.file) {
                read_library(found);
            } else {
                tally_.note(
                    "resource.missing",
                    fmt::format("material library \"{}\" is not in the upload{}", name, resources_.listing()),
                    "mtllib");
            }
        }
    }

    void read_library(const Found& library) {
        if (!read_paths_.insert(library.path).second) return;
        const ByteView bytes = library.file->bytes;
        document_->libraries.push_back({library.path, {bytes.begin(), bytes.end()}});
        for (MtlMaterial& m : parse_mtl(as_text(bytes), library.path, tally_)) {
            require(defined_.size() < limits_.meshes_and_primitives, ErrorCode::asset_too_large, library.path,
                    "more materials than the limit meshes_and_primitives of {}",
                    limits_.meshes_and_primitives);
            const std::string name = m.material.name;
            defined_.emplace(name, Definition{std::move(m), library.path});  // the first of a name counts
        }
    }

    Material material(const std::string& name) {
        const auto at = defined_.find(name);
        if (at == defined_.end()) {
            if (!file_.libraries.empty()) {
                tally_.note("material.missing", fmt::format("no library defines material \"{}\"", name),
                            "usemtl");
            }
            Material plain;
            plain.name = name;
            return plain;
        }
        const auto& [mtl, library] = at->second;
        Material m = mtl.material;
        m.base_color_texture.image = image(mtl.base_color_path, library);
        m.emissive_texture.image = image(mtl.emissive_path, library);
        m.normal_texture.image = image(mtl.normal_path, library);
        return m;
    }

    std::optional<uint32_t> image(const std::string& path, const std::string& library) {
        if (path.empty()) return std::nullopt;
        const Found found = find_texture(path, library);
        if (!found.file) return std::nullopt;
        const auto [at, is_new] = images_.emplace(found.path, static_cast<uint32_t>(scene_.images.size()));
        if (is_new) {
            require(scene_.images.size() < limits_.images, ErrorCode::asset_too_large, library,
                    "more images than the limit images of {}", limits_.images);
            const ByteView bytes = found.file->bytes;
            scene_.images.push_back({found.path.substr(found.path.rfind('/') + 1),
                                     std::string(image_mime_type(bytes)),
                                     found.path,
                                     {bytes.begin(), bytes.end()}});
        }
        return at->second;
    }

    Found find_texture(const std::string& path, const std::string& library) {
        const auto [at, is_new] = textures_.try_emplace({library, path});
        if (!is_new) return at->second;
        at->second = find(path, folder_of(library), library);
        if (!at->second.file) {
            tally_.note("resource.missing",
                        fmt::format("texture \"{}\" is not in the upload{}", path, resources_.listing()),
                        library);
        }
        return at->second;
    }

    // Textures that only OBJ can name (Ks, Ns, ...), and those of materials that no face uses.
    void keep_other_textures() {
        std::set<std::string> kept;
        for (const auto& [name, definition] : defined_) {
            for (const std::string& path : definition.mtl.paths) {
                const Found found = find_texture(path, definition.library);
                if (!found.file || images_.contains(found.path) || !kept.insert(found.path).second) continue;
                require(kept.size() <= limits_.images, ErrorCode::asset_too_large, definition.library,
                        "more images than the limit images of {}", limits_.images);
                const ByteView bytes = found.file->bytes;
                document_->textures.push_back({found.path, {bytes.begin(), bytes.end()}});
            }
        }
    }

    struct Definition {
        MtlMaterial mtl;
        std::string library;
    };

    const ObjFile& file_;
    const Resources& resources_;
    const ReadLimits& limits_;
    Scene& scene_;
    WarningTally tally_;
    std::shared_ptr<ObjDocument> document_ = std::make_shared<ObjDocument>();
    std::map<std::string, Definition> defined_;  // by name, ordered: what is kept must not depend on hashes
    std::map<std::pair<std::string, std::string>, Found> textures_;  // by library and path
    std::set<std::string> read_paths_;
    std::unordered_map<std::string, uint32_t> images_;  // by path
};

}  // namespace

void read_materials(const ObjFile& file, const Resources& resources, const ReadLimits& limits, Scene& scene) {
    MaterialReader(file, resources, limits, scene).read();
}

}  // namespace coppice
