// SPDX-License-Identifier: Apache-2.0
#include "solver/device/contact_list.hpp"

namespace scree {

template <int D, class T>
ContactList<D, T>::ContactList(Device& device, std::array<double, 3> lower, double cell_size)
    : lower_(lower),
      cell_size_(cell_size),
      record_(device, "contacts"),
      begin_(device, "contacts"),
      collider_(device, "contacts"),
      position_(device, "contacts"),
      normal_(device, "contacts"),
      impulse_(device, "contacts"),
      holds_(device, "contacts"),
      settled_(device, "contacts"),
      sum_begin_(device, "contacts"),
      sum_list_(device, "contacts"),
      surfaces_(device, "contacts") {}

template <int D, class T>
bool ContactList<D, T>::has_moved(const std::vector<Collider>& colliders) const {
  if (displacement_.size() != colliders.size()) return true;
  for (std::size_t c = 0; c < colliders.size(); ++c) {
    for (int a = 0; a < 3; ++a) {
      if (displacement_[c][a] != colliders[c].displacement()[a]) return true;
    }
  }
  return false;
}

/// The contacts of one block's nodes, node after node.
template <int D, class T>
void ContactList<D, T>::find(const Grid<D, T>& grid, int block,
                             const std::vector<Collider>& colliders,
                             std::vector<Contact>& out) const {
  const BlockCoord<D> corner = grid.topology().coord(block);
  std::vector<std::int32_t> near;
  for (std::size_t c = 0; c < colliders.size(); ++c) {
    const Box box = colliders[c].bounds();
    bool apart = false;
    for (int a = 0; a < D; ++a) {
      const double low = lower_[std::size_t(a)] + cell_size_ * block_cells * corner[std::size_t(a)];
      const double high = low + cell_size_ * (block_cells + 1);
      apart = apart || high < box.lower[a] || low - cell_size_ > box.upper[a];
    }
    if (!apart) near.push_back(std::int32_t(c));
  }
  if (near.empty()) return;
  for (int i = 0; i < grid.lattices() * block_node_count<D>; ++i) {
    const int lattice = i / block_node_count<D>;
    const BlockCoord<D> node = grid.node(block, i % block_node_count<D>);
    std::array<double, 3> x = lower_;
    for (std::size_t a = 0; a < D; ++a) x[a] += cell_size_ * (node[a] + 0.5 * lattice);
    const std::int64_t record = std::int64_t(block) * grid.lattices() * block_node_count<D> + i;
    for (const std::int32_t c : near) {
      const Collider& collider = colliders[std::size_t(c)];
      if (!collider.touches(x.data())) continue;
      const Vec3<double> n = collider.normal(x.data());
      const Vec3<double> place = collider.unwrapped(x.data());
      out.push_back({record, c, {place[0], place[1], place[2]}, {n[0], n[1], n[2]}});
    }
  }
}

template <int D, class T>
void ContactList<D, T>::upload(const std::vector<std::vector<Contact>>& found,
                               std::size_t colliders) {
  std::vector<std::int64_t> record;
  std::vector<std::int32_t> begin;
  std::vector<std::int32_t> collider;
  std::vector<double> position;
  std::vector<double> normal;
  std::vector<std::vector<std::int32_t>> of_collider(colliders);
  for (const auto& of_block : found) {
    for (const Contact& contact : of_block) {
      const auto k = std::int32_t(collider.size());
      if (record.empty() || record.back() != contact.record) {
        record.push_back(contact.record);
        begin.push_back(k);
      }
      collider.push_back(contact.collider);
      position.insert(position.end(), contact.position.begin(), contact.position.end());
      normal.insert(normal.end(), contact.normal.begin(), contact.normal.end());
      of_collider[std::size_t(contact.collider)].push_back(k);
    }
  }
  begin.push_back(std::int32_t(collider.size()));
  std::vector<std::int32_t> sum_begin{0};
  std::vector<std::int32_t> sum_list;
  for (const auto& list : of_collider) {
    sum_list.insert(sum_list.end(), list.begin(), list.end());
    sum_begin.push_back(std::int32_t(sum_list.size()));
  }
  record_.upload(record);
  begin_.upload(begin);
  collider_.upload(collider);
  position_.upload(position);
  normal_.upload(normal);
  impulse_.resize(normal.size());
  holds_.resize(collider.size());
  settled_.resize(3 * record.size());
  sum_begin_.upload(sum_begin);
  sum_list_.upload(sum_list);
}

template <int D, class T>
void ContactList<D, T>::update(const Grid<D, T>& grid, const std::vector<Collider>& colliders,
                               ThreadPool& pool) {
  std::vector<ContactSurface> surfaces;
  for (const Collider& collider : colliders) {
    ContactSurface surface{collider.contact(), collider.coefficient(), {0, 0, 0}, {0, 0, 0}};
    for (int a = 0; a < 3; ++a) {
      surface.velocity[a] = collider.velocity()[a];
      surface.centre[a] = collider.reference_point()[a];
    }
    surfaces.push_back(surface);
  }
  surfaces_.upload(surfaces);
  if (known_ && !has_moved(colliders)) return;
  std::vector<std::vector<Contact>> found(std::size_t(grid.topology().size()));
  pool.for_each(
      std::int64_t(found.size()),
      [&](std::int64_t b, int) { find(grid, int(b), colliders, found[std::size_t(b)]); }, 8);
  upload(found, colliders.size());
  displacement_.clear();
  for (const Collider& collider : colliders) displacement_.push_back(collider.displacement());
  known_ = true;
}

template <int D, class T>
ContactNodes ContactList<D, T>::nodes() const {
  ContactNodes nodes;
  nodes.nodes = std::int32_t(record_.size());
  nodes.record = record_.data();
  nodes.begin = begin_.data();
  nodes.collider = collider_.data();
  nodes.normal = normal_.data();
  nodes.impulse = impulse_.data();
  nodes.holds = holds_.data();
  nodes.settled = settled_.data();
  return nodes;
}

template <int D, class T>
ContactSums ContactList<D, T>::sums() const {
  return {std::int32_t(displacement_.size()), sum_begin_.data(), sum_list_.data(),
          position_.data()};
}

template <int D, class T>
std::int64_t ContactList<D, T>::bytes() const {
  return std::int64_t(record_.bytes() + begin_.bytes() + collider_.bytes() + position_.bytes() +
                      normal_.bytes() + impulse_.bytes() + holds_.bytes() + settled_.bytes() +
                      sum_begin_.bytes() + sum_list_.bytes() + surfaces_.bytes());
}

template class ContactList<2, float>;
template class ContactList<2, double>;
template class ContactList<3, float>;
template class ContactList<3, double>;

}  // namespace scree
