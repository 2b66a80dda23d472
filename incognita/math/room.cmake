incognita_room(math SOURCES math/chart.cpp math/quaternion.cpp math/random.cpp USES Eigen3::Eigen)
