#include "robot_model/joint_order.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <tuple>

namespace nao {
namespace {

constexpr int kNoLimb = std::numeric_limits<int>::max();

struct Branch {
  const UrdfEdge* edge = nullptr;
  /** Least rank of the limbs in the subtree, and whether the subtree has a body. */
  int limb = kNoLimb;
  bool has_body = false;
  std::vector<Branch> children;
};

/** Rank 0 for branches without a limb: they come first. */
auto key_of(const Branch& branch) {
  return std::make_tuple(branch.limb == kNoLimb ? 0 : branch.limb, branch.edge->place);
}

}  // namespace

std::vector<UrdfEdge> order_joints(const std::string& root, const std::vector<UrdfEdge>& edges,
                                   const std::map<std::string, int>& limb_of_link) {
  // Children of each link. Order within a link is by limb and place, so that the order does not
  // depend on that of the URDF's elements.
  std::map<std::string, std::vector<const UrdfEdge*>> edges_of;
  for (const UrdfEdge& edge : edges) edges_of[edge.parent].push_back(&edge);

  // Recursion from the root; each branch knows the least limb rank of its subtree.
  const std::function<std::vector<Branch>(const std::string&)> grow = [&](const std::string& link) {
    std::vector<Branch> branches;
    for (const UrdfEdge* edge : edges_of[link]) {
      Branch branch;
      branch.edge = edge;
      branch.has_body = edge->is_body;
      const auto limb = limb_of_link.find(edge->child);
      if (limb != limb_of_link.end()) branch.limb = limb->second;
      branch.children = grow(edge->child);
      for (const Branch& child : branch.children) {
        branch.limb = std::min(branch.limb, child.limb);
        branch.has_body = branch.has_body || child.has_body;
      }
      branches.push_back(std::move(branch));
    }
    std::stable_sort(branches.begin(), branches.end(),
                     [](const Branch& a, const Branch& b) { return key_of(a) < key_of(b); });
    return branches;
  };

  std::vector<UrdfEdge> ordered;
  // Depth first, in two passes: first all bodies, then frames without bodies (sensors, cameras).
  // Within a frame's subtree everything is a frame.
  const std::function<void(const std::vector<Branch>&, bool, bool)> list =
      [&](const std::vector<Branch>& branches, bool bodies, bool inside_frame) {
        for (const Branch& branch : branches) {
          const bool is_frame = inside_frame || !branch.has_body;
          if (is_frame != bodies) ordered.push_back(*branch.edge);
          if (!(bodies && is_frame)) list(branch.children, bodies, is_frame);
        }
      };
  const std::vector<Branch> branches = grow(root);
  list(branches, true, false);
  list(branches, false, false);
  return ordered;
}

}  // namespace nao
