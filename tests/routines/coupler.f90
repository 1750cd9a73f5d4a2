! The couplers of coupler.c, as Fortran writes them.
subroutine cousub(id, time, par, npar, disp, ndisp, iflag, value)
  implicit none
  integer, intent(in) :: id, npar, ndisp
  double precision, intent(in) :: time, par(*), disp(*)
  logical, intent(in) :: iflag
  double precision, intent(out) :: value
  value = disp(1) - par(1) * sin(disp(2)) - par(2) * disp(2)
  if (ndisp > 2) value = value - par(3) * disp(3)**2
end subroutine

subroutine couxx(id, time, par, npar, disp, ndisp, iflag, value)
  implicit none
  integer, intent(in) :: id, npar, ndisp
  double precision, intent(in) :: time, par(*), disp(*)
  logical, intent(in) :: iflag
  double precision, intent(out) :: value(*)
  value(1) = 1
  value(2) = -par(1) * cos(disp(2)) - par(2)
  if (ndisp > 2) value(3) = -2 * par(3) * disp(3)
end subroutine

subroutine couxx2(id, time, par, npar, disp, ndisp, iflag, value)
  implicit none
  integer, intent(in) :: id, npar, ndisp
  double precision, intent(in) :: time, par(*), disp(*)
  logical, intent(in) :: iflag
  double precision, intent(out) :: value(ndisp, ndisp)
  value = 0
  value(2, 2) = par(1) * sin(disp(2))
  if (ndisp > 2) value(3, 3) = -2 * par(3)
end subroutine
