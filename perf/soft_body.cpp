#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>

#include "perf/perf.hpp"

namespace cullet::perf {

// Yardstick (a) of springs: Bullet's own links, as given and after its reordering.
bool measure_soft_body(const Options& options, Figures& figures) {
    constexpr int kIterations = 20;
    btSoftBodyWorldInfo info;
    info.m_sparsesdf.Initialize();
    for (const bool is_ordered : {false, true}) {
        btSoftBody* body =
            btSoftBodyHelpers::CreatePatch(info, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}, 107, 107, 0, true);
        if (is_ordered) btSoftBodyHelpers::ReoptimizeLinkOrder(body);
        const auto solve = btSoftBody::getSolver(btSoftBody::ePSolver::Linear);
        body->setTotalMass(1);
        body->updateLinkConstants();
        for (int i = 0; i < body->m_links.size(); ++i) {
            btSoftBody::Link& link = body->m_links[i];
            link.m_c3 = link.m_n[1]->m_q - link.m_n[0]->m_q;
            link.m_c2 = 1 / (link.m_c3.length2() * link.m_c0);
        }
        double least = 1e9;
        for (uint32_t round = 0; round < (options.rounds ? options.rounds : 50); ++round)
            least = std::min(least, seconds([&] {
                                 for (int i = 0; i < kIterations; ++i) solve(body, 1, 0);
                             }));
        const double links = body->m_links.size();
        if (!is_ordered) figures.add("links", links, "");
        figures.add(is_ordered ? "a link and iteration, reordered" : "a link and iteration, as given",
                    1e9 * least / (kIterations * links), "ns");
        delete body;
    }
    return true;
}

}  // namespace cullet::perf
