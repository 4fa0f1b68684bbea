// What the claims share: settings, folders, meshes of strangers, and measurements that several of them speak of.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "cullet/result.hpp"
#include "engine/mesh.hpp"
#include "sample_game/model_shelf.hpp"
#include "sample_game/png.hpp"
#include "sample_game/reproduce/claim.hpp"

namespace cullet::reproduce {

struct Settings {
    std::string out;          // a folder that is there
    std::string data;         // of test meshes; may be missing
    uint32_t threads = 0;     // that step worlds and share pixels; 0: all
    bool is_reduced = false;  // smaller meshes, fewer repeats and smaller pictures: for tests
};

class Bench {
 public:
    explicit Bench(Settings settings);

    const Settings& settings() const { return settings_; }
    uint32_t threads() const;
    const std::shared_ptr<ModelShelf>& shelf() const { return shelf_; }
    uint32_t picture_width() const { return settings_.is_reduced ? 320 : 960; }

    /// "thick_shell/spot_triangulated.obj" of the test data, scaled to a largest side of `size`; nothing when it is not
    /// there or cannot be read, which notes() then says.
    std::optional<Mesh> strangers_mesh(const std::string& path, float size);
    const std::vector<std::string>& notes() const { return notes_; }
    void note(std::string sentence);

    /// Writes DIR/id_name.png and puts it into the claim.
    Result<void> add_picture(Claim& claim, const Picture& picture, const std::string& name, const std::string& caption);

    /// DIR/id_name1.png and so on. The last caption serves the pictures that have none of their own, and so does one
    /// that is empty its predecessor's.
    Result<void> add_pictures(Claim& claim, std::span<const Picture> pictures, const std::string& name,
                              std::vector<std::string> captions);

    /// What make() returns, a Result<T>, made at the first call of that name: several rows of the page speak of it.
    template <class Make>
    auto once(const std::string& name, Make make) -> const decltype(make())& {
        using Made = decltype(make());
        std::shared_ptr<void>& kept = kept_[name];
        if (!kept) kept = std::make_shared<Made>(make());
        return *static_cast<const Made*>(kept.get());
    }

 private:
    Settings settings_;
    std::shared_ptr<ModelShelf> shelf_;
    std::map<std::string, std::optional<Mesh>> meshes_;
    std::map<std::string, std::shared_ptr<void>> kept_;
    std::vector<std::string> notes_;
};

/// s, of a clock that only rises.
double seconds_now();

/// Fills all but `seconds`. A refusal ends the whole command: it is a bug of ours or a full disk.
using MakeClaim = Result<Claim> (*)(Bench& bench);

struct ClaimEntry {
    const char* id;
    MakeClaim make;
};

}  // namespace cullet::reproduce
