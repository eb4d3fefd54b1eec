#include "planner/roadmap/spectral_embedding.h"

#include <Spectra/MatOp/DenseSymMatProd.h>
#include <Spectra/SymEigsSolver.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace regrasp::roadmap {

namespace {

/// Lanczos vectors an eigenvalue, as Spectra's manual recommends at least two.
constexpr int kVectorsPerEigenvalue = 2;
constexpr int kFewestVectors = 20;
constexpr int kMaxRestarts = 1000;
/// Of eigenvalues, whose largest is 1.
constexpr double kEigenvalueTolerance = 1e-12;
/// Directions with smaller eigenvalues are noise, which their inverse would blow up.
constexpr double kSmallestInverted = 1e-9;

struct EigenPairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// All eigenvalues at once: for few points, and for where the iteration does not converge.
EigenPairs LargestOfAll(const Eigen::MatrixXd& matrix, int count) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues().reverse().head(count),
          solver.eigenvectors().rowwise().reverse().leftCols(count)};
}

EigenPairs LargestEigenPairs(const Eigen::MatrixXd& matrix, int count) {
  const int lanczos = std::max(kFewestVectors, kVectorsPerEigenvalue * count + 1);
  if (lanczos >= matrix.rows()) return LargestOfAll(matrix, count);
  Spectra::DenseSymMatProd<double> product(matrix);
  Spectra::SymEigsSolver<Spectra::DenseSymMatProd<double>> solver(product, count, lanczos);
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge, kMaxRestarts, kEigenvalueTolerance);
  if (solver.info() != Spectra::CompInfo::Successful) return LargestOfAll(matrix, count);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace

SpectralEmbedding EmbedAffinity(const Eigen::MatrixXd& affinity, int dimension) {
  if (dimension < 1 || dimension >= affinity.rows()) {
    throw std::invalid_argument("a spectral embedding has 1 to n - 1 dimensions");
  }
  SpectralEmbedding embedding;
  embedding.degrees = affinity.rowwise().sum();
  const Eigen::VectorXd scale = embedding.degrees.cwiseSqrt().cwiseInverse();
  EigenPairs pairs =
      LargestEigenPairs(scale.asDiagonal() * affinity * scale.asDiagonal(), dimension);
  embedding.eigenvalues = std::move(pairs.values);
  embedding.vectors = std::move(pairs.vectors);
  embedding.rows = embedding.vectors.rowwise().normalized();
  return embedding;
}

Eigen::RowVectorXd EmbedAnother(const SpectralEmbedding& embedding,
                                const Eigen::VectorXd& affinity) {
  const Eigen::VectorXd row =
      affinity.cwiseQuotient((affinity.sum() * embedding.degrees).cwiseSqrt());
  Eigen::RowVectorXd placed = row.transpose() * embedding.vectors;
  for (Eigen::Index i = 0; i < placed.size(); ++i) {
    const double eigenvalue = embedding.eigenvalues[i];
    placed[i] = std::abs(eigenvalue) < kSmallestInverted ? 0 : placed[i] / eigenvalue;
  }
  return placed.normalized();
}

}  // namespace regrasp::roadmap
