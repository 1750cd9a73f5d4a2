! The linear equations of state_equations.c as Fortran writes them: matrices row by row, one behind the other.
subroutine linear(first_m, first_n, rows, par, value)
  implicit none
  integer, intent(in) :: first_m, first_n, rows
  double precision, intent(in) :: par(*)
  double precision, intent(out) :: value(rows)
  integer :: n, m, r, c
  logical :: wanted
  double precision :: x(8), u(8), by_x(rows, 8), by_u(rows, 8)
  call gse_ns(n)
  call gse_ni(m)
  call gse_x(x, n)
  call gse_u(u, m)
  do r = 1, rows
    do c = 1, n
      by_x(r, c) = par(first_m + n * (r - 1) + c)
    end do
    do c = 1, m
      by_u(r, c) = par(first_n + m * (r - 1) + c)
    end do
    value(r) = dot_product(by_x(r, 1:n), x(1:n)) + dot_product(by_u(r, 1:m), u(1:m))
  end do
  call adams_needs_partials(wanted)
  if (.not. wanted) return
  call gsepar_x(by_x(:, 1:n), rows * n)
  call gsepar_u(by_u(:, 1:m), rows * m)
end subroutine

subroutine gse_deriv(id, time, par, npar, dflag, iflag, ns, xdot)
  implicit none
  integer, intent(in) :: id, npar, ns
  double precision, intent(in) :: time, par(*)
  logical, intent(in) :: dflag, iflag
  double precision, intent(out) :: xdot(ns)
  call linear(0, ns * ns, ns, par, xdot)
end subroutine

subroutine gse_output(id, time, par, npar, dflag, iflag, no, y)
  implicit none
  integer, intent(in) :: id, npar, no
  double precision, intent(in) :: time, par(*)
  logical, intent(in) :: dflag, iflag
  double precision, intent(out) :: y(no)
  integer :: n, m
  call gse_ns(n)
  call gse_ni(m)
  call linear(n * (n + m), n * (n + m) + no * n, no, par, y)
end subroutine

subroutine gsesub(id, time, par, npar, dflag, iflag, ns, x, ni, u, no, xdot, y)
  implicit none
  integer, intent(in) :: id, npar, ns, ni, no
  double precision, intent(in) :: time, par(*), x(ns), u(ni)
  logical, intent(in) :: dflag, iflag
  double precision, intent(out) :: xdot(ns), y(no)
  xdot = matmul(transpose(reshape(par(1:ns * ns), (/ ns, ns /))), x) &
       + matmul(transpose(reshape(par(ns * ns + 1:ns * (ns + ni)), (/ ni, ns /))), u)
  y = matmul(transpose(reshape(par(ns * (ns + ni) + 1:ns * (ns + ni) + no * ns), (/ ns, no /))), x) &
    + matmul(transpose(reshape(par(ns * (ns + ni) + no * ns + 1:(ns + ni) * (ns + no)), (/ ni, no /))), u)
end subroutine

subroutine gsexx(id, time, par, npar, iflag, ns, x, ni, u, no, matrix)
  implicit none
  integer, intent(in) :: id, npar, ns, ni, no
  double precision, intent(in) :: time, par(*), x(ns), u(ni)
  logical, intent(in) :: iflag
  double precision, intent(out) :: matrix(ns, ns)
  matrix = transpose(reshape(par(1:ns * ns), (/ ns, ns /)))
end subroutine

subroutine gsexu(id, time, par, npar, iflag, ns, x, ni, u, no, matrix)
  implicit none
  integer, intent(in) :: id, npar, ns, ni, no
  double precision, intent(in) :: time, par(*), x(ns), u(ni)
  logical, intent(in) :: iflag
  double precision, intent(out) :: matrix(ns, ni)
  matrix = transpose(reshape(par(ns * ns + 1:ns * (ns + ni)), (/ ni, ns /)))
end subroutine

subroutine gseyx(id, time, par, npar, iflag, ns, x, ni, u, no, matrix)
  implicit none
  integer, intent(in) :: id, npar, ns, ni, no
  double precision, intent(in) :: time, par(*), x(ns), u(ni)
  logical, intent(in) :: iflag
  double precision, intent(out) :: matrix(no, ns)
  matrix = transpose(reshape(par(ns * (ns + ni) + 1:ns * (ns + ni) + no * ns), (/ ns, no /)))
end subroutine

subroutine gseyu(id, time, par, npar, iflag, ns, x, ni, u, no, matrix)
  implicit none
  integer, intent(in) :: id, npar, ns, ni, no
  double precision, intent(in) :: time, par(*), x(ns), u(ni)
  logical, intent(in) :: iflag
  double precision, intent(out) :: matrix(no, ni)
  matrix = transpose(reshape(par(ns * (ns + ni) + no * ns + 1:(ns + ni) * (ns + no)), (/ ni, no /)))
end subroutine
