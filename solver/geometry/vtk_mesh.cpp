// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPLYReader.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "solver/geometry/mesh_file.hpp"
#include "solver/geometry/polygon.hpp"
#include "solver/geometry/word_reader.hpp"

namespace scree {
namespace {

/// Keeps what VTK would print.
class Messages : public vtkOutputWindow {
 public:
  static Messages* New();
  void DisplayText(const char* text) override { text_ += text; }
  /// The last sentence of the first message, which says what is wrong.
  std::string first() const {
    const std::size_t colon = text_.find("): ");
    std::string rest = colon == std::string::npos ? text_ : text_.substr(colon + 3);
    return rest.substr(0, rest.find('\n'));
  }
  bool empty() const { return text_.empty(); }

 private:
  std::string text_;
};
vtkStandardNewMacro(Messages)

    template <class Reader>
    vtkSmartPointer<vtkDataSet> read(const std::string& path) {
  vtkNew<Messages> messages;
  const vtkSmartPointer<vtkOutputWindow> before = vtkOutputWindow::GetInstance();
  vtkOutputWindow::SetInstance(messages);
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkSmartPointer<vtkDataSet> result = reader->GetOutput();
  vtkOutputWindow::SetInstance(before);
  if (!messages->empty())
    throw GeometryFault("file", "cannot be read by VTK: " + messages->first());
  if (result == nullptr || result->GetNumberOfPoints() == 0)
    throw GeometryFault("file", "holds no points, or VTK cannot read it");
  return result;
}

/// Cells by the integers on them.
class Regions {
 public:
  explicit Regions(vtkDataSet* data)
      : cells_(data->GetCellData()), count_(data->GetNumberOfCells()) {
    for (int i = 0; i < cells_->GetNumberOfArrays(); ++i) {
      vtkDataArray* array = cells_->GetArray(i);
      if (array == nullptr || array->GetNumberOfComponents() != 1) continue;
      const int type = array->GetDataType();
      if (type != VTK_FLOAT && type != VTK_DOUBLE) arrays_.push_back(array);
    }
  }

  /// Which cells belong to the region, all if it is empty.
  std::vector<char> select(const std::string& region) const {
    std::vector<char> selected(std::size_t(count_), region.empty() ? 1 : 0);
    if (region.empty()) return selected;
    const std::size_t sign = region.rfind('=');
    std::int64_t value = 0;
    const std::string text = sign == std::string::npos ? region : region.substr(sign + 1);
    vtkDataArray* array = find(sign == std::string::npos ? "" : region.substr(0, sign));
    if (array == nullptr || !WordReader::number(text, value)) unknown_region(region, known());
    for (vtkIdType c = 0; c < count_; ++c)
      selected[std::size_t(c)] = array->GetTuple1(c) == double(value);
    if (std::count(selected.begin(), selected.end(), 1) == 0) unknown_region(region, known());
    return selected;
  }

 private:
  /// Without a name: the only array.
  vtkDataArray* find(const std::string& name) const {
    if (name.empty()) return arrays_.size() == 1 ? arrays_[0] : nullptr;
    for (vtkDataArray* array : arrays_)
      if (array->GetName() != nullptr && name == array->GetName()) return array;
    return nullptr;
  }
  std::vector<std::string> known() const {
    std::vector<std::string> names;
    for (vtkDataArray* array : arrays_)
      for (vtkIdType c = 0; c < count_; ++c) {
        const char* name = array->GetName() == nullptr ? "" : array->GetName();
        std::string entry = fmt::format("{}={:.0f}", name, array->GetTuple1(c));
        if (std::find(names.begin(), names.end(), entry) == names.end()) names.push_back(entry);
        if (names.size() >= 20) return names;
      }
    return names;
  }

  vtkCellData* cells_;
  vtkIdType count_;
  std::vector<vtkDataArray*> arrays_;
};

/// The surface of the selected cells.
class Surface {
 public:
  Surface(vtkDataSet* data, const std::vector<char>& selected) : data_(data) {
    mesh_.points.resize(std::size_t(data->GetNumberOfPoints()));
    for (vtkIdType p = 0; p < data->GetNumberOfPoints(); ++p)
      data->GetPoint(p, mesh_.points[std::size_t(p)].data());
    bool space = false;
    for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
      space = space || (selected[std::size_t(c)] && data->GetCell(c)->GetCellDimension() == 3);
    for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c) {
      vtkCell* cell = data->GetCell(c);
      if (!selected[std::size_t(c)] || cell->GetCellDimension() != (space ? 3 : 2)) continue;
      if (!space) add(cell);
      for (int f = 0; space && f < cell->GetNumberOfFaces(); ++f) note_face(c, f);
    }
    if (space) add_outer_faces();
  }

  TriangleMesh take() && { return std::move(mesh_); }

 private:
  struct Face {
    std::vector<vtkIdType> points;  ///< ascending: the same from both sides
    vtkIdType cell;
    int index;
  };

  void note_face(vtkIdType cell, int index) {
    vtkIdList* ids = data_->GetCell(cell)->GetFace(index)->GetPointIds();
    Face face{{ids->begin(), ids->end()}, cell, index};
    std::sort(face.points.begin(), face.points.end());
    faces_.push_back(std::move(face));
  }

  /// Faces between two cells of the region are inside it.
  void add_outer_faces() {
    std::sort(faces_.begin(), faces_.end(), [](const Face& a, const Face& b) {
      return std::tie(a.points, a.cell, a.index) < std::tie(b.points, b.cell, b.index);
    });
    for (std::size_t first = 0, last = 0; first < faces_.size(); first = last) {
      while (last < faces_.size() && faces_[last].points == faces_[first].points) ++last;
      if ((last - first) % 2 != 0)
        add(data_->GetCell(faces_[first].cell)->GetFace(faces_[first].index));
    }
  }

  void add(vtkCell* polygon) {
    const int type = polygon->GetCellType();
    if (type == VTK_TRIANGLE || type == VTK_QUAD || type == VTK_POLYGON) {
      vtkIdList* ids = polygon->GetPointIds();
      add_polygon(mesh_, {ids->begin(), ids->end()});
      return;
    }
    vtkNew<vtkIdList> ids;
    vtkNew<vtkPoints> points;
    polygon->Triangulate(0, ids, points);
    for (vtkIdType i = 0; i + 2 < ids->GetNumberOfIds(); i += 3)
      mesh_.triangles.push_back({std::int32_t(ids->GetId(i)), std::int32_t(ids->GetId(i + 1)),
                                 std::int32_t(ids->GetId(i + 2))});
  }

  vtkDataSet* data_;
  TriangleMesh mesh_;
  std::vector<Face> faces_;
};

}  // namespace

TriangleMesh read_with_vtk(const std::string& path, const std::string& region) {
  const std::string ending = path.substr(path.size() - 3);
  const auto is = [&](const char* lower, const char* upper) {
    return ending == lower || ending == upper;
  };
  vtkSmartPointer<vtkDataSet> data;
  if (is("ply", "PLY")) data = read<vtkPLYReader>(path);
  if (is("vtp", "VTP")) data = read<vtkXMLPolyDataReader>(path);
  if (is("vtu", "VTU")) data = read<vtkXMLUnstructuredGridReader>(path);
  if (data == nullptr) throw GeometryFault("file", "has an unknown ending");
  return Surface(data, Regions(data).select(region)).take();
}

}  // namespace scree
