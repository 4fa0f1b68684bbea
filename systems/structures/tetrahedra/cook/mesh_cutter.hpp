// A cut that is made bit by bit: a break has no frame that is long enough for all of it.
#pragma once
#include <optional>
#include <string>

#include "systems/structures/tetrahedra/cook/triangle_cutter.hpp"

namespace cullet {

/// What the request names must stay as long as this does.
class MeshCutter {
 public:
    explicit MeshCutter(const CutRequest& request);
    MeshCutter(const MeshCutter&) = delete;
    MeshCutter& operator=(const MeshCutter&) = delete;

    /// About so many polygons more, or what follows when all triangles are cut. True: it is done.
    bool advance(size_t polygons);
    /// What the last step looked at.
    size_t polygons_made() const { return polygons_made_; }
    bool is_joining() const { return next_ == count_ && cutter_->is_done(); }
    /// When it is done.
    Result<Cut> take();

 private:
    void begin();
    void join();

    CutRequest request_;
    GridPoints points_;
    List<uint8_t> is_known_;
    CutTriangles of_triangles_;
    std::optional<TriangleCutter> cutter_;
    size_t count_ = 0, next_ = 0;  // triangles asked for
    size_t polygons_made_ = 0;
    Cut cut_;
    std::string error_;
};

}  // namespace cullet
