; P1 as a goal: nothing says that the cup has to change hands, or where. It stands on the floor, which is no
; region of the cell: nothing can be put there.
(define (problem p1)
  (:domain stacking-arms)
  (:objects right left - arm top - grasp cup1 - thing floor red-region box-top - place)
  (:init (empty left) (empty right) (in cup1 floor))
  (:goal (in cup1 red-region)))
