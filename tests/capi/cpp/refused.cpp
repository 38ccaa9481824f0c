/* What must not compile, with a message that says what to do instead. */
#include <carvel.hpp>

#include <Eigen/Core>

struct Triangles {
    static constexpr bool is_trimesh() { return true; }
    using Point = std::array<float, 3>;
    using TexCoord2D = std::array<float, 2>;
};

void refused(Eigen::Matrix<double, Eigen::Dynamic, 3> &by_column,
             Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> &by_row,
             std::vector<int> &integers, Triangles &triangles)
{
    carvel::rows(by_column);
    carvel::columns(by_row);
    carvel::values(by_column);
    carvel::values(integers);
    static_cast<void>(carvel::openmesh::try_write(carvel::Refined<float>(), triangles));
}
